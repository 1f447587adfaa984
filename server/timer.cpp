#include "timer.h"

namespace sundial {

Timer::Timer() {
  thread_ = std::thread([this] { work(); });
}

Timer::~Timer() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

Timer::Id Timer::at(Clock::time_point time, Function function) {
  const std::lock_guard lock(mutex_);
  const Id id{time, ++last_};
  const auto it = waiting_.emplace(id, std::move(function)).first;
  if (it == waiting_.begin()) changed_.notify_one();
  return id;
}

void Timer::forget(Id id) {
  std::map<Id, Function>::node_type dropped;  // destroyed without the lock
  const std::lock_guard lock(mutex_);
  dropped = waiting_.extract(id);
}

void Timer::work() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    if (waiting_.empty()) {
      changed_.wait(lock);
      continue;
    }
    const auto first = waiting_.begin();
    if (const auto time = first->first.first; time > Clock::now()) {
      changed_.wait_until(lock, time);
      continue;
    }
    auto due = waiting_.extract(first);
    lock.unlock();
    due.mapped()();
    due = {};
    lock.lock();
  }
}

}  // namespace sundial
