#include "command/interrupt.h"

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>

namespace sundial::command {
namespace {

int checked(int result, const char* what) {
  if (result < 0) throw std::system_error(errno, std::generic_category(), what);
  return result;
}

}  // namespace

Interrupt::Interrupt() : wake_(checked(eventfd(0, EFD_CLOEXEC), "eventfd")) {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  const int arriving = checked(signalfd(-1, &signals, SFD_CLOEXEC), "signalfd");
  thread_ = std::thread([this, arriving] {
    std::array<pollfd, 2> waiting{{{arriving, POLLIN, 0}, {wake_, POLLIN, 0}}};
    while (!(waiting[1].revents & POLLIN)) {
      if (poll(waiting.data(), waiting.size(), -1) < 0) continue;  // EINTR
      if (!(waiting[0].revents & POLLIN)) continue;
      signalfd_siginfo info{};
      if (read(arriving, &info, sizeof info) != sizeof info) continue;
      signal_ = static_cast<int>(info.ssi_signo);
      source_.request_stop();
    }
    close(arriving);
  });
}

Interrupt::~Interrupt() {
  eventfd_write(wake_, 1);
  thread_.join();
  close(wake_);
}

}  // namespace sundial::command
