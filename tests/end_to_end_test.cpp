// The command and the real server together: every bad request is one line that names its cause, and the
// server goes on serving; the same request gives the same bytes, whatever the number of threads.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "fake_server.h"
#include "process.h"

namespace sundial::test {
namespace {

namespace fs = std::filesystem;

long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

// A sundiald on a socket of its own, ready before the constructor returns.
class Server {
 public:
  explicit Server(const std::vector<std::string>& environment = {}, const std::vector<std::string>& more = {})
      : address("unix:" + (folder.path() / "socket").string()) {
    std::vector<std::string> arguments{"--listen", address, "--scene-root", folder.path().string(),
                                       "--validation"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    process.emplace(SUNDIALD, arguments, environment);
    waitForServer(address);
  }
  ~Server() {
    if (process) stop();
  }
  Outcome stop() {
    process->signal(SIGTERM);
    Outcome outcome = process->wait();
    process.reset();
    return outcome;
  }
  Outcome operator()(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--server", address});
    return sundial(arguments);
  }

  TemporaryFolder folder;
  std::string address;
  std::optional<Process> process;
};

class EndToEndTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { server = std::make_unique<Server>(); }
  static void TearDownTestSuite() {
    const Outcome outcome = server->stop();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("vulkan:"), std::string::npos)
        << "the validation layer spoke: " << outcome.err;
    server.reset();
  }

  std::string file(const std::string& name) const { return (server->folder.path() / name).string(); }
  std::string written(const std::string& name, const std::string& bytes) const {
    std::ofstream(file(name), std::ios::binary) << bytes;
    return file(name);
  }

  // Fails with this status and one line with all of these words; then the server still renders.
  void expectRefused(const std::vector<std::string>& arguments, int status,
                     const std::vector<std::string>& words) const {
    const Outcome outcome = (*server)(arguments);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in " << outcome.err;
    EXPECT_EQ((*server)(render("builtin:grid", "ok.png")).status, 0);
  }
  std::vector<std::string> render(const std::string& scene, const std::string& to,
                                  const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"render", scene,   "--method", "sm,texels=256",
                                       "--size", "64x64", "-o",       file(to)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  static std::unique_ptr<Server> server;
};
std::unique_ptr<Server> EndToEndTest::server;

// A glTF of one triangle whose parts the tests break.
std::string triangle(const std::string& index = "2", float x = 0) {
  const float positions[9] = {x, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint16_t indices[3] = {0, 1, static_cast<std::uint16_t>(std::stoi(index))};
  std::string bytes(44, '\0');
  std::memcpy(bytes.data(), positions, 36);
  std::memcpy(bytes.data() + 36, indices, 6);
  std::string json =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"scene":0,"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":44}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
      R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    const auto v = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&v), 4);
  };
  return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + bytes.size()) + word(json.size()) + "JSON" +
         json + word(bytes.size()) + std::string("BIN\0", 4) + bytes;
}

TEST_F(EndToEndTest, rendersAFileOfOneTriangle) {
  EXPECT_EQ((*server)(render(written("good.glb", triangle()), "good.png")).status, 0);
  EXPECT_TRUE(fs::exists(file("good.png")));
}

TEST_F(EndToEndTest, refusesAFileCutOff) {
  const std::string whole = triangle();
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{3}, std::size_t{15}, std::size_t{200}, whole.size() - 1})
    expectRefused(render(written("cut.glb", whole.substr(0, size)), "cut.png"), 1, {"cut.glb"});
  EXPECT_FALSE(fs::exists(file("cut.png")));
}

TEST_F(EndToEndTest, refusesWhatIsNoGltf) {
  expectRefused(render(written("text.glb", "This is a letter, not a scene."), "no.png"), 1,
                {"text.glb", "glTF"});
}

TEST_F(EndToEndTest, refusesAnIndexOutOfRange) {
  expectRefused(render(written("index.glb", triangle("7")), "no.png"), 1, {"index", "7"});
}

TEST_F(EndToEndTest, refusesAVertexThatIsNoNumber) {
  expectRefused(render(written("nan.glb", triangle("2", std::nanf(""))), "no.png"), 1, {"finite"});
}

TEST_F(EndToEndTest, refusesSizesOutOfRange) {
  expectRefused({"render", "builtin:grid", "--method", "sm", "--size", "0x0", "-o", file("no.png")}, 2,
                {"0x0"});
  const Outcome huge = (*server)(
      {"render", "builtin:grid", "--method", "sm", "--size", "100000x100000", "-o", file("no.png")});
  EXPECT_TRUE(huge.status == 1 || huge.status == 2) << huge.status;
  EXPECT_EQ(lines(huge.err), 1) << huge.err;
  EXPECT_NE(huge.err.find("8192"), std::string::npos) << huge.err;
}

TEST_F(EndToEndTest, refusesAMethodThatIsNotThere) {
  expectRefused({"render", "builtin:grid", "--method", "nonesuch", "-o", file("no.png")}, 1,
                {"nonesuch", "sm, dv"});
}

TEST_F(EndToEndTest, refusesParametersThatAreNotThere) {
  expectRefused({"render", "builtin:grid", "--method", "sm,speed=11", "-o", file("no.png")}, 1,
                {"speed", "texels"});
  expectRefused({"render", "builtin:grid", "--method", "sm,texels=3", "-o", file("no.png")}, 1,
                {"texels=3", "[16, 16384]"});
  expectRefused({"render", "builtin:grid", "--method", "sm,kernel=3", "-o", file("no.png")}, 1,
                {"kernel", "pcf"});
}

TEST_F(EndToEndTest, refusesAPortInUse) {
  ASSERT_EQ((*server)(render("builtin:grid", "ok.png")).status, 0);  // so that the first one listens
  Process second(SUNDIALD, {"--listen", server->address});
  const Outcome outcome = second.wait();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("in use"), std::string::npos) << outcome.err;
  EXPECT_EQ((*server)(render("builtin:grid", "ok.png")).status, 0);
}

TEST_F(EndToEndTest, refusesADeviceThatIsNotThere) {
  TemporaryFolder other;
  Process process(SUNDIALD, {"--listen", "unix:" + (other.path() / "s").string(), "--device", "nonesuch"});
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("nonesuch"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("0 \""), std::string::npos) << "lists the devices: " << outcome.err;
}

TEST_F(EndToEndTest, comparesWithTruth) {
  const Outcome outcome = (*server)({"--json", "compare", "builtin:grid", "--method", "sm,texels=512",
                                     "--method", "ray-traced", "--size", "128x128", "--repetitions", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto report = nlohmann::json::parse(outcome.out);
  const auto& results = report["results"];
  ASSERT_EQ(results.size(), 2u);
  EXPECT_LT(results[0]["measures"]["pixel_match"].get<double>(), 1);
  EXPECT_GT(results[0]["measures"]["pixel_match"].get<double>(), 0.95);
  EXPECT_EQ(results[1]["measures"]["pixel_match"].get<double>(), 1);
  EXPECT_EQ(results[0]["plan"]["views"].size(), 1u);
}

TEST(Repeatability, theSameRequestGivesTheSameBytesForAnyNumberOfThreads) {
  std::string first;
  for (const char* threads : {"LP_NUM_THREADS=0", "LP_NUM_THREADS=1", "LP_NUM_THREADS=2"}) {
    const Server server({threads});
    const std::string picture = (server.folder.path() / "all.exr").string();
    for (int repeat = 0; repeat < 2; ++repeat) {
      const Outcome outcome = server({"render", "builtin:trees?count=20", "--method", "dv,texels=512",
                                      "--size", "256x192", "--aov", "all", "-o", picture});
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      const std::string bytes = contents(picture);
      EXPECT_FALSE(bytes.empty());
      if (first.empty()) first = bytes;
      EXPECT_TRUE(bytes == first) << threads << ", time " << repeat;
    }
  }
}

}  // namespace
}  // namespace sundial::test
