// One thread that does tasks in the order in which they come: what may wait for a disk or a parser is done
// here and not on a thread that serves clients.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace sundial {

class Worker {
 public:
  // Called once, with true when the worker stopped before the task's turn. Must not throw.
  using Task = std::move_only_function<void(bool stopped)>;

  explicit Worker(std::size_t maxWaiting);
  ~Worker();  // stop()
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // False, and the task is dropped uncalled, when `maxWaiting` tasks wait or the worker has stopped. Any
  // thread.
  [[nodiscard]] bool post(Task);
  // Ends the task that runs, tells those that wait, joins. Not from the worker's own thread.
  void stop();

 private:
  void work();

  const std::size_t maxWaiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Task> tasks_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace sundial
