// A sundiald without a renderer, for tests of the command's private server. It says into the file (a FIFO)
// $FAKE_SUNDIALD_LOG "listening PID SOCKET" and "rendering", and keeps it open while it lives.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "fake_server.h"

int main(int argc, char** argv) {
  sigset_t ending;
  sigemptyset(&ending);
  sigaddset(&ending, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &ending, nullptr);

  std::string address;
  for (int i = 1; i + 1 < argc; ++i)
    if (std::string(argv[i]) == "--listen") address = argv[i + 1];
  std::FILE* log = std::fopen(std::getenv("FAKE_SUNDIALD_LOG"), "w");
  const auto say = [&](const std::string& line) {
    fmt::print(log, "{}\n", line);
    std::fflush(log);
  };
  sundial::test::FakeServer server(address);
  if (std::getenv("FAKE_SUNDIALD_HANGS")) server.hang = [&] { say("rendering"); };
  say(fmt::format("listening {} {}", getpid(), address.substr(5)));
  int signal = 0;
  sigwait(&ending, &signal);
}
