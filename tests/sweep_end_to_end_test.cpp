// A sweep over two real servers, one of which is killed, by a client that is killed: nothing is lost, and the
// lines are those of an undisturbed sweep, byte for byte apart from times.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/inotify.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>

#include "fake_server.h"
#include "gltf_file.h"
#include "process.h"
#include "sweep_lines.h"

namespace sundial::test {
namespace {

namespace fs = std::filesystem;

// A port that was free a moment ago.
std::string freeAddress() {
  const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  socklen_t size = sizeof address;
  getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size);
  close(descriptor);
  return "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
}

// A sundiald that can be killed and started again at its address.
class Server {
 public:
  Server() { start(); }
  ~Server() { die(SIGTERM); }
  void start() { process_.emplace(SUNDIALD, std::vector<std::string>{"--listen", address}); }
  void die(int signal) {
    process_->signal(signal);
    process_->wait();
  }
  const std::string address = freeAddress();

 private:
  std::optional<Process> process_;
};

long linesOf(const std::string& path) {
  if (!fs::exists(path)) return 0;
  const std::string text = contents(path);
  return std::count(text.begin(), text.end(), '\n');
}

// Returns when the file has so many lines; false if nothing is written for a minute.
bool awaitLines(const fs::path& path, long count) {
  const int changes = inotify_init1(IN_CLOEXEC);
  inotify_add_watch(changes, path.parent_path().c_str(), IN_MODIFY);
  bool written = true;
  while (written && linesOf(path.string()) < count) {
    pollfd waiting{changes, POLLIN, 0};
    written = poll(&waiting, 1, 60'000) > 0;
    char events[4096];
    if (written) written = read(changes, events, sizeof events) > 0;
  }
  close(changes);
  return written;
}

TEST(SweepEndToEnd, KillingAServerAndTheClientChangesNothing) {
  TemporaryFolder folder;
  const auto path = [&](const std::string& name) { return (folder.path() / name).string(); };
  std::ofstream(path("square.glb"), std::ios::binary) << squareFile().glb();
  std::ofstream(path("spec.textproto")) << R"(repetitions: 1 max_repetitions: 1
    group { scene: "builtin:grid" scene: "./square.glb" size { width: 96 height: 64 }
      method { name: "sm" parameter { key: "texels" value: ["64", "128", "256", "512", "1024"] } }
      method { name: "dv" parameter { key: "texels" value: ["64", "128", "256", "512", "1024"] } }
      method { name: "ray-traced" }
      method { name: "sm" parameter { key: "texels" value: "three" } }
    }
    group { scene: "builtin:grid" size { width: 96 height: 64 } path { name: "orbit" } frames: 4 points: 400
      method { name: "sm" parameter { key: "texels" value: ["128", "256"] } }
      method { name: "dv" parameter { key: "texels" value: ["128", "256"] } }
    })";
  constexpr long kCases = 28;

  Server a, b;
  const auto command = [&](const std::string& results, const std::string& more = "--quiet") {
    return std::vector<std::string>{"--server", a.address + "," + b.address,
                                    "sweep",    path("spec.textproto"),
                                    "-o",       results,
                                    "--images", path("p"),
                                    more};
  };
  const Outcome undisturbed = sundial(command(path("undisturbed.jsonl")));
  ASSERT_EQ(undisturbed.status, 1) << undisturbed.err;  // two cases can't be
  EXPECT_NE(undisturbed.err.find("2 of 28 cases failed"), std::string::npos) << undisturbed.err;
  const auto whole = withoutTimes(path("undisturbed.jsonl"));
  ASSERT_EQ(whole.size(), static_cast<std::size_t>(kCases));

  const std::string results = path("disturbed.jsonl");
  {
    Process client(SUNDIAL_COMMAND, command(results));
    ASSERT_TRUE(awaitLines(results, 5));
    a.die(SIGKILL);
    ASSERT_TRUE(awaitLines(results, 11));
    client.signal(SIGKILL);
    client.wait();
  }
  ASSERT_LT(linesOf(results), kCases) << "it ended before it was killed";
  std::ofstream(results, std::ios::app) << R"({"case":"0123)";
  a.start();
  b.die(SIGKILL);
  b.start();
  const Outcome resumed = sundial(command(results, "--resume"));
  EXPECT_EQ(resumed.status, 1) << resumed.err;
  EXPECT_EQ(withoutTimes(results), whole);
}

// A map of the whole scene stands still while the camera moves; one that follows the view samples doesn't.
TEST(SweepEndToEnd, AMovingCameraFlipsWhatFollowsIt) {
  const TemporaryFolder folder;
  const std::string spec = (folder.path() / "spec").string(), results = (folder.path() / "r").string();
  std::ofstream(spec) << R"(repetitions: 1 max_repetitions: 1
    group { scene: "builtin:grid" size { width: 96 height: 64 } path { name: "orbit" } frames: 6 points: 1000
      method { name: "sm" parameter { key: "texels" value: "256" } }
      method { name: "dv" parameter { key: "texels" value: "256" } } })";
  const Outcome outcome = sundial({"sweep", spec, "-o", results});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::map<std::string, nlohmann::json> lines;
  std::istringstream file(contents(results));
  for (std::string text; std::getline(file, text);) {
    const auto line = nlohmann::json::parse(text);
    lines[line["method"]] = line;
  }
  EXPECT_EQ(lines["sm"]["stability"]["flip_rate"], 0);
  EXPECT_EQ(lines["sm"]["stability"]["texel_jump"], 0);
  EXPECT_GT(lines["dv"]["stability"]["flip_rate"], 0);
  EXPECT_GT(lines["dv"]["stability"]["pairs"], 0);
  for (const auto& [method, line] : lines) {
    EXPECT_GT(line["measures"]["pixel_match"], 0.5) << method;
    EXPECT_LT(line["measures"]["pixel_match"], 1) << method;
  }
}

// No two frame times are alike, so this target is never met, and a wide one always is.
TEST(SweepEndToEnd, NoiseIsAnsweredWithRepetitionsUpToTheLimit) {
  const TemporaryFolder folder;
  const std::string spec = (folder.path() / "spec").string(), results = (folder.path() / "r").string();
  for (const auto& [target, taken] : {std::pair{"1e-12", 5}, {"1e6", 2}, {"0", 2}}) {
    fs::remove(results);
    std::ofstream(spec)
        << "repetitions: 2 max_repetitions: 5 quartile_target: " << target
        << R"( group { scene: "builtin:grid" size { width: 64 height: 64 } method { name: "sm" } })";
    const Outcome outcome = sundial({"sweep", spec, "-o", results});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(contents(results))["repetitions"], taken) << target;
  }
}

}  // namespace
}  // namespace sundial::test
