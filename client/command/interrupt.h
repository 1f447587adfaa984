// Ctrl-C and SIGTERM as a stop token, so that everything is put away before the command ends.
#pragma once

#include <atomic>
#include <stop_token>
#include <thread>

namespace sundial::command {

// Make one before any other thread exists: it blocks the signals in the threads to come.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return source_.get_token(); }
  int signal() const { return signal_; }  // that came; 0 if none did

 private:
  std::stop_source source_;
  std::atomic<int> signal_ = 0;
  int wake_;  // eventfd: ends the thread
  std::thread thread_;
};

}  // namespace sundial::command
