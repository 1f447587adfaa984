// Calls functions at times: deadlines and readers that make no progress.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

namespace sundial {

class Timer {
 public:
  using Clock = std::chrono::steady_clock;
  using Function = std::move_only_function<void()>;
  using Id = std::pair<Clock::time_point, std::uint64_t>;

  Timer();
  ~Timer();  // drops what hasn't been called
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

  // Calls `function` on the timer's thread, not before `time`. It must not throw or wait. Any thread.
  Id at(Clock::time_point time, Function function);
  void forget(Id);  // unless its call has begun

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<Id, Function> waiting_;
  std::uint64_t last_ = 0;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace sundial
