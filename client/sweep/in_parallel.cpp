#include "sweep/in_parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace sundial::sweep {

void inParallel(std::size_t count, unsigned threads, std::stop_source stop,
                const std::function<void(std::size_t)>& job) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr first;
  const auto work = [&] {
    for (std::size_t i; !stop.stop_requested() && (i = next++) < count;) try {
        job(i);
      } catch (...) {
        {
          const std::lock_guard lock(mutex);
          if (!first) first = std::current_exception();
        }
        stop.request_stop();
      }
  };
  {
    std::vector<std::jthread> workers;
    for (std::size_t i = 0; i < std::min<std::size_t>(threads, count); ++i) workers.emplace_back(work);
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace sundial::sweep
