#include "command/private_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/inotify.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "command/failure.h"
#include "sundial/connect.h"

namespace sundial::command {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
constexpr milliseconds kStartTime{60'000};  // a first start may compile its shaders' pipelines
constexpr milliseconds kStopTime{10'000};
constexpr milliseconds kGlance{50};  // how often the wait for a start looks for an interrupt

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {
    if (fd < 0) throw failure(fmt::format("can't start a server: {}", std::strerror(errno)));
  }
  ~Descriptor() { close(fd_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

bool executable(const fs::path& path) { return access(path.c_str(), X_OK) == 0 && !fs::is_directory(path); }

fs::path findServer() {
  if (const char* chosen = getenv("SUNDIALD")) {
    if (executable(chosen)) return chosen;
    throw failure(fmt::format("$SUNDIALD is '{}', which can't be run; correct or unset it", chosen));
  }
  const fs::path beside = fs::read_symlink("/proc/self/exe").parent_path() / "sundiald";
  if (executable(beside)) return beside;
  std::string_view path = getenv("PATH") ? getenv("PATH") : "";
  while (!path.empty()) {
    const auto colon = path.find(':');
    const fs::path candidate = fs::path(path.substr(0, colon)) / "sundiald";
    if (executable(candidate)) return candidate;
    path.remove_prefix(colon == std::string_view::npos ? path.size() : colon + 1);
  }
  throw failure(
      "there is no sundiald beside sundial or on the PATH; install it, set SUNDIALD, or give --server");
}

std::string lastLine(int file) {
  std::string text(static_cast<std::size_t>(std::max<off_t>(lseek(file, 0, SEEK_END), 0)), '\0');
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(pread(file, text.data(), text.size(), 0), 0)));
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

// A fresh folder for the socket, that only its owner may enter.
class PrivateServer::Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "sundial-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
      throw failure(fmt::format("can't make a folder in {}: {}; set TMPDIR",
                                fs::temp_directory_path().string(), std::strerror(errno)));
    path_ = pattern;
  }
  ~Folder() {
    std::error_code ignored;  // nothing is left to do about a folder that can't be removed
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path socket() const { return path_ / "s"; }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

class PrivateServer::Process {
 public:
  explicit Process(std::vector<std::string> command) : log_(memfd_create("sundiald", MFD_CLOEXEC)) {
    std::vector<char*> arguments;
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ < 0) throw failure(fmt::format("can't start a server: {}", std::strerror(errno)));
    if (pid_ == 0) run(arguments.data(), parent);
    watch_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
  }

  ~Process() {
    if (!dead_) {
      kill(pid_, SIGTERM);
      if (!diesWithin(kStopTime)) kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    close(watch_);
  }

  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int watch() const { return watch_; }  // readable once the process is dead

  bool diesWithin(milliseconds time) const {
    pollfd waiting{watch_, POLLIN, 0};
    return poll(&waiting, 1, static_cast<int>(time.count())) > 0;
  }

  // Call when it is dead: why, in its own words.
  Failure epitaph() {
    int status = 0;
    waitpid(pid_, &status, 0);
    dead_ = true;
    std::string line = lastLine(log_.get());
    if (line.empty() && WIFSIGNALED(status))
      line = fmt::format("it was ended by signal {}", WTERMSIG(status));
    if (line.empty()) line = fmt::format("it said nothing; status {}", WEXITSTATUS(status));
    return failure(fmt::format("sundiald didn't start: {}", line));
  }

 private:
  // Between fork and exec only async-signal-safe calls are allowed.
  [[noreturn]] void run(char* const* arguments, pid_t parent) const {
    sigset_t none;
    sigemptyset(&none);
    pthread_sigmask(SIG_SETMASK, &none, nullptr);
    setpgid(0, 0);  // Ctrl-C is for the command, which then stops its server
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(log_.get(), STDOUT_FILENO);
    dup2(log_.get(), STDERR_FILENO);
    execv(arguments[0], arguments);
    _exit(127);
  }

  Descriptor log_;
  pid_t pid_ = -1;
  int watch_ = -1;
  bool dead_ = false;
};

PrivateServer::PrivateServer(const PrivateServerOptions& options, std::stop_token stop) {
  const Folder folder;
  const Descriptor arrivals(inotify_init1(IN_CLOEXEC | IN_NONBLOCK));
  inotify_add_watch(arrivals.get(), folder.path().c_str(), IN_CREATE | IN_MOVED_TO);

  std::vector<std::string> command{findServer().string(), "--listen", "unix:" + folder.socket().string()};
  if (!options.sceneRoot.empty()) command.insert(command.end(), {"--scene-root", options.sceneRoot});
  if (!options.device.empty()) command.insert(command.end(), {"--device", options.device});
  process_ = std::make_unique<Process>(std::move(command));

  // The socket's file announces the server; its death or an interrupt end the wait.
  const auto deadline = std::chrono::steady_clock::now() + kStartTime;
  const auto check = [&] {
    if (process_->diesWithin(milliseconds(0))) throw process_->epitaph();
    if (stop.stop_requested()) throw failure("interrupted");
    if (std::chrono::steady_clock::now() > deadline)
      throw failure("sundiald doesn't answer after a minute; start it by hand to see why");
  };
  while (!fs::exists(folder.socket())) {
    check();
    std::array<pollfd, 2> waiting{{{arrivals.get(), POLLIN, 0}, {process_->watch(), POLLIN, 0}}};
    poll(waiting.data(), waiting.size(), static_cast<int>(kGlance.count()));
    std::array<char, 4096> events;
    while (read(arrivals.get(), events.data(), events.size()) > 0) continue;
  }
  auto channel = client::connect("unix:" + folder.socket().string());
  if (!channel) throw failure(channel.error().message);
  channel_ = std::move(*channel);
  while (!channel_->WaitForConnected(std::chrono::system_clock::now() + kGlance)) check();
}

PrivateServer::~PrivateServer() = default;

}  // namespace sundial::command
