#include "worker.h"

#include <utility>

namespace sundial {

Worker::Worker(std::size_t maxWaiting) : maxWaiting_(maxWaiting) {
  thread_ = std::thread([this] { work(); });
}

Worker::~Worker() { stop(); }

bool Worker::post(Task task) {
  const std::lock_guard lock(mutex_);
  if (stopping_ || tasks_.size() >= maxWaiting_) return false;
  tasks_.push_back(std::move(task));
  changed_.notify_one();
  return true;
}

void Worker::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return stopping_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    Task task = std::move(tasks_.front());
    tasks_.pop_front();
    const bool stopped = stopping_;
    lock.unlock();
    task(stopped);
    task = nullptr;  // before the lock: it may hold the last reference to something that locks
    lock.lock();
  }
}

void Worker::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

}  // namespace sundial
