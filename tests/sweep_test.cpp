// `sundial sweep` against servers that misbehave: every case becomes one line, whatever happens on the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <future>
#include <set>

#include "fake_server.h"
#include "process.h"
#include "sweep_lines.h"

namespace sundial::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kSpec = R"(repetitions: 2 group {
  scene: "builtin:discs" size { width: 32 height: 24 }
  method { name: "sm" parameter { key: "texels" value: ["16", "32", "64", "128", "256", "512"] } }
  method { name: "dv" parameter { key: "texels" value: ["16", "32", "64", "128"] } }
  method { name: "ray-traced" }
}
group {
  scene: "builtin:discs" size { width: 32 height: 24 } path { name: "walk" } frames: 3 points: 9
  method { name: "sm" parameter { key: "texels" value: "64" } }
  method { name: "dv" parameter { key: "texels" value: "64" } }
})";
constexpr std::size_t kCases = 13, kAlongPaths = 2;

class SweepTest : public testing::Test {
 protected:
  TemporaryFolder folder;
  FakeServer server{"127.0.0.1:0"};
  const std::string spec = written("spec.textproto", kSpec);
  const std::string results = path("r.jsonl");

  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  std::string written(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  static std::string addressOf(const FakeServer& one) { return "127.0.0.1:" + std::to_string(one.port()); }

  std::vector<std::string> command(const std::vector<std::string>& more = {},
                                   std::string servers = {}) const {
    if (servers.empty()) servers = addressOf(server);
    std::vector<std::string> all{"--server", servers, "sweep", spec, "-o", results};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome sweep(const std::vector<std::string>& more = {}, const std::string& servers = {}) const {
    return sundial(command(more, servers));
  }
  // What a sweep without any trouble finds.
  std::map<std::string, std::string> undisturbed() const {
    FakeServer good("127.0.0.1:0");
    const std::string file = path("undisturbed.jsonl");
    fs::remove(file);
    EXPECT_EQ(sundial({"--server", addressOf(good), "sweep", spec, "-o", file}).status, 0);
    return withoutTimes(file);
  }
  std::vector<json> lines() const {
    std::vector<json> all;
    std::istringstream file(contents(results));
    for (std::string text; std::getline(file, text);) all.push_back(json::parse(text));
    return all;
  }
};

TEST_F(SweepTest, WritesALineForEveryCase) {
  const Outcome outcome = sweep();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, results + ": 13 cases, 13 rendered, 0 done before, 0 failed\n");
  ASSERT_EQ(lines().size(), kCases);
  for (const json& line : lines()) {
    for (const char* name : {"case",
                             "scene",
                             "view_name",
                             "view",
                             "light_name",
                             "light",
                             "size",
                             "device",
                             "driver",
                             "baseline",
                             "repetitions",
                             "method",
                             "parameters",
                             "frame_ms",
                             "frame_quartiles",
                             "ratio_to_baseline",
                             "ratio_quartiles",
                             "measures",
                             "passes",
                             "plan"})
      EXPECT_TRUE(line.contains(name)) << name << " in " << line;
    for (const char* name : {"images", "error"}) EXPECT_FALSE(line.contains(name)) << name;
    EXPECT_EQ(line.contains("stability"), line.contains("motion"));
    EXPECT_EQ(line["case"].get<std::string>().size(), 16u);
    EXPECT_EQ(line["scene"], "builtin:discs");
    EXPECT_EQ(line["size"], (json{32, 24}));
    EXPECT_EQ(line["device"], "fake device");
    EXPECT_EQ(line["driver"], "fake driver 1.0");
    EXPECT_EQ(line["baseline"], "sm,texels=2048");
    EXPECT_EQ(line["repetitions"], 2);
    EXPECT_TRUE(line["frame_ms"].is_number());
    EXPECT_EQ(line["ratio_quartiles"].size(), 2u);
    EXPECT_TRUE(line["measures"]["edge_error_px"]["p95"].is_number());
    EXPECT_TRUE(line["view"]["eye"]["x"].is_number());
  }
  EXPECT_EQ(server.lastRequest.max_repetitions(), 25u);
  EXPECT_EQ(server.lastRequest.quartile_target(), 0.1);
}

// One line has both: how steady the method is along the path, and how right at its first frame.
TEST_F(SweepTest, AlongAPathALineHasStabilityAndTheAccuracyOfTheFirstFrame) {
  const std::string one =
      written("one.textproto", R"(group { scene: "builtin:discs" size { width: 32 height: 24 }
    path { name: "walk" } method { name: "dv" } frames: 3 points: 9 seed: 5 })");
  ASSERT_EQ(sundial({"--server", addressOf(server), "sweep", one, "-o", results}).status, 0);
  ASSERT_EQ(lines().size(), 1u);
  const json line = lines()[0];
  EXPECT_EQ(
      line["motion"],
      (json{{"path_name", "walk"}, {"light_path_name", ""}, {"frames", 3}, {"points", 9}, {"seed", 5}}));
  EXPECT_EQ(line["stability"]["flip_rate"], 0.25);
  EXPECT_EQ(line["stability"]["frames"], 3);
  for (const char* name : {"pop", "texel_jump", "wrong_rate", "points", "pairs"})
    EXPECT_TRUE(line["stability"][name].is_number()) << name;
  EXPECT_EQ(server.lastRun.frames(), 3u);
  EXPECT_EQ(server.lastRun.points(), 9u);
  EXPECT_EQ(server.lastRun.seed(), 5u);
  EXPECT_EQ(server.lastRequest.view().vertical_fov_degrees(), 70);  // the fake path's
  EXPECT_EQ(line["view"]["target"]["z"], -4);
  EXPECT_EQ(line["view_name"], "");
  EXPECT_TRUE(line["measures"]["pixel_match"].is_number());
}

TEST_F(SweepTest, APathThatIsNotThereIsALine) {
  const std::string one =
      written("one.textproto", R"(group { scene: "builtin:discs" size { width: 8 height: 8 }
    path { name: "nowhere" } method { name: "sm" } })");
  EXPECT_EQ(sundial({"--server", addressOf(server), "sweep", one, "-o", results}).status, 1);
  ASSERT_EQ(lines().size(), 1u);
  EXPECT_EQ(lines()[0]["error"]["message"], "the scene has no path 'nowhere': it has walk");
  EXPECT_EQ(lines()[0]["motion"]["path_name"], "nowhere");
  EXPECT_FALSE(lines()[0].contains("stability"));
  EXPECT_EQ(server.renderings, 0);
}

TEST_F(SweepTest, RefusesWhatItCanRefuseBeforeItAsks) {
  const auto expectRefused = [&](const Outcome& outcome, const std::string& says) {
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
  };
  for (const char* shard : {"0/2", "3/2", "1", "1/", "/2", "a/b", "1/2x", "-1/2", "1/0"})
    expectRefused(sweep({"--shard", shard}), "--shard");
  expectRefused(sundial({"sweep", path("gone"), "-o", results}), "gone");
  expectRefused(sundial({"sweep", written("bad", "group { scene: 7 }"), "-o", results}), "line 1");
  expectRefused(sweep({"--images", spec}), "--images");
  EXPECT_FALSE(fs::exists(results));
  written("r.jsonl", "");
  expectRefused(sweep(), "--resume");
  EXPECT_EQ(server.renderings, 0);
}

TEST_F(SweepTest, ACaseThatFailsIsALineAndTheSweepGoesOn) {
  server.judge = [](const v1::RenderRequest& request) {
    const auto& texels = request.methods(0).parameters();
    if (request.methods(0).name() == "dv" && texels.at("texels") == "32")
      return grpc::Status(grpc::INVALID_ARGUMENT, "methods[0]: texels=32 is out of luck");
    if (request.methods(0).name() == "ray-traced")
      return grpc::Status(grpc::RESOURCE_EXHAUSTED, "over the limit");  // without a hint: for good
    return grpc::Status::OK;
  };
  const Outcome outcome = sweep();
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("2 of 13 cases failed"), std::string::npos) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  ASSERT_EQ(lines().size(), kCases);
  std::map<std::string, std::string> errors;
  for (const json& line : lines())
    if (line.contains("error")) {
      errors[line["method"]] =
          line["error"]["code"].get<std::string>() + " " + line["error"]["message"].get<std::string>();
      for (const char* name : {"frame_ms", "ratio_to_baseline", "measures", "plan", "repetitions"})
        EXPECT_FALSE(line.contains(name)) << name;
    }
  EXPECT_EQ(errors, (std::map<std::string, std::string>{
                        {"dv", "INVALID_ARGUMENT methods[0]: texels=32 is out of luck"},
                        {"ray-traced", "RESOURCE_EXHAUSTED over the limit"}}));
  EXPECT_EQ(server.renderings, static_cast<int>(kCases));

  // They are done: nothing is asked again, and the status is the same.
  EXPECT_EQ(sweep({"--resume"}).status, 1);
  EXPECT_EQ(server.renderings, static_cast<int>(kCases));
}

TEST_F(SweepTest, ResumesAfterATornLine) {
  const auto whole = undisturbed();
  ASSERT_EQ(sweep().status, 0);
  const std::string text = contents(results);
  // The first four lines and a part of the fifth.
  std::size_t end = 0;
  for (int i = 0; i < 4; ++i) end = text.find('\n', end) + 1;
  written("r.jsonl", text.substr(0, end + 57));
  server.renderings = 0;
  const Outcome outcome = sweep({"--resume", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(server.renderings, static_cast<int>(kCases) - 4);
  EXPECT_EQ(withoutTimes(results), whole);
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["resumed"], 4);
  EXPECT_EQ(summary["rendered"], 9);
  EXPECT_EQ(summary["failed"], 0);
}

TEST_F(SweepTest, ShardsMergeByConcatenation) {
  const auto whole = undisturbed();
  std::string merged;
  for (int i = 1; i <= 3; ++i) {
    const std::string part = path("part" + std::to_string(i));
    ASSERT_EQ(sundial({"--server", addressOf(server), "sweep", spec, "-o", part, "--shard",
                       std::to_string(i) + "/3"})
                  .status,
              0);
    merged += contents(part);
  }
  EXPECT_EQ(withoutTimes(written("merged", merged)), whole);
}

TEST_F(SweepTest, WaitsForAFullQueueHoweverLong) {
  server.queueFull = 200;
  ASSERT_EQ(sweep().status, 0);
  EXPECT_EQ(server.renderings + server.runs, static_cast<int>(kCases + kAlongPaths) + 200);
  EXPECT_EQ(withoutTimes(results), undisturbed());
}

TEST_F(SweepTest, RendersAgainWhatBreaksOff) {
  std::atomic<int> breaks = 6, runBreaks = 3;
  for (const grpc::Status& how :
       {grpc::Status(grpc::UNAVAILABLE, "killed"), grpc::Status(grpc::UNKNOWN, "a proxy's server was killed"),
        grpc::Status::OK}) {
    fs::remove(results);
    breaks = 6, runBreaks = 3;
    server.brokenOff = how;
    server.tamper = [&](const v1::RenderEvent& event) { return !(event.has_timings() && breaks-- > 0); };
    server.tamperRun = [&](const v1::StabilityEvent& event) {
      return !(event.has_outcome() && runBreaks-- > 0);
    };
    ASSERT_EQ(sweep().status, 0) << how.error_code();
    EXPECT_EQ(withoutTimes(results), undisturbed());
    EXPECT_LE(breaks, 0);
    EXPECT_LE(runBreaks, 0);
  }
}

TEST_F(SweepTest, ACaseThatKillsServersIsOneLine) {
  server.brokenOff = {grpc::UNAVAILABLE, "killed"};
  const std::string one =
      written("one.textproto", R"(group { scene: "builtin:discs" size { width: 8 height: 8 }
    method { name: "sm" } })");
  server.tamper = [&](const v1::RenderEvent& event) { return !event.has_timings(); };
  const Outcome outcome = sundial({"--server", addressOf(server), "sweep", one, "-o", results});
  EXPECT_EQ(outcome.status, 1);
  ASSERT_EQ(lines().size(), 1u);
  EXPECT_EQ(lines()[0]["error"]["code"], "UNAVAILABLE");
  EXPECT_NE(lines()[0]["error"]["message"].get<std::string>().find("lost 10 times"), std::string::npos);
  EXPECT_EQ(server.renderings, 10);
}

TEST_F(SweepTest, SurvivesTheOnlyServersDeath) {
  const auto whole = undisturbed();
  auto first = std::make_unique<FakeServer>("127.0.0.1:0");
  const std::string address = addressOf(*first);
  std::promise<void> arrived;
  std::once_flag once;
  std::atomic<int> good = 3;
  first->judge = [&](const v1::RenderRequest&) {
    if (good-- <= 0) std::call_once(once, [&] { arrived.set_value(); });
    return good < 0 ? grpc::Status(grpc::UNAVAILABLE, "dying") : grpc::Status::OK;
  };
  Process process(SUNDIAL_COMMAND, command({}, address));
  arrived.get_future().wait();
  first.reset();
  FakeServer second(address);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(withoutTimes(results), whole);
}

TEST_F(SweepTest, OneOfTwoServersIsEnough) {
  auto other = std::make_unique<FakeServer>("127.0.0.1:0");
  const std::string both = addressOf(server) + "," + addressOf(*other);
  std::promise<void> arrived;
  std::once_flag once;
  other->hang = [&] { std::call_once(once, [&] { arrived.set_value(); }); };
  Process process(SUNDIAL_COMMAND, command({}, both));
  arrived.get_future().wait();  // what it has accepted hangs until it dies
  other.reset();
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(withoutTimes(results), undisturbed());
}

TEST_F(SweepTest, GivesUpWhenNoServerIsLeftAndLosesNothing) {
  std::string gone;
  {
    FakeServer dead("127.0.0.1:0");
    gone = addressOf(dead);
  }
  const Outcome none = sweep({"--patience", "0"}, gone);
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.err.find("no server has answered"), std::string::npos) << none.err;
  EXPECT_NE(none.err.find("--resume"), std::string::npos) << none.err;
  EXPECT_EQ(std::ranges::count(none.err, '\n'), 1) << none.err;

  std::atomic<int> good = 3;
  server.judge = [&](const v1::RenderRequest&) {
    return good-- > 0 ? grpc::Status::OK : grpc::Status(grpc::UNAVAILABLE, "gone");
  };
  const Outcome some = sweep({"--patience", "0", "--resume"});
  EXPECT_EQ(some.status, 1);
  EXPECT_NE(some.err.find(" of 13 cases are in "), std::string::npos) << some.err;
  EXPECT_LE(lines().size(), 3u);
  server.judge = {};
  EXPECT_EQ(sweep({"--resume"}).status, 0);
  EXPECT_EQ(withoutTimes(results), undisturbed());
}

TEST_F(SweepTest, AKilledClientLosesNothing) {
  std::promise<void> arrived;
  std::once_flag once;
  std::atomic<int> good = 5;
  server.judge = [&](const v1::RenderRequest&) {
    if (good-- <= 0) std::call_once(once, [&] { arrived.set_value(); });
    return grpc::Status::OK;
  };
  Process process(SUNDIAL_COMMAND, command());
  arrived.get_future().wait();
  process.signal(SIGKILL);
  EXPECT_EQ(process.wait().status, 128 + SIGKILL);
  EXPECT_EQ(sweep({"--resume"}).status, 0);
  EXPECT_EQ(withoutTimes(results), undisturbed());
}

TEST_F(SweepTest, SendsALocalSceneToEachServerAndAgainToOneThatForgets) {
  written("a.gltf", "{}");
  FakeServer other("127.0.0.1:0");
  const std::string local =
      written("local.textproto", R"(group { scene: "./a.gltf" size { width: 8 height: 8 }
    method { name: "sm" parameter { key: "texels" value: ["16", "32", "64", "128", "256", "512", "1024"] } }
    method { name: "dv" parameter { key: "texels" value: ["16", "32", "64", "128", "256", "512", "1024"] } } })");
  std::atomic<bool> served = false, forgot = false;
  server.tamper = [&](const v1::RenderEvent& event) {
    if (event.has_done()) served = true;
    return true;
  };
  server.judge = [&](const v1::RenderRequest&) {
    if (served && !forgot.exchange(true)) server.forget();
    return grpc::Status::OK;
  };
  const Outcome outcome =
      sundial({"--server", addressOf(server) + "," + addressOf(other), "sweep", local, "-o", results});
  ASSERT_EQ(outcome.status, 0) << outcome.err << contents(results);
  EXPECT_EQ(lines().size(), 14u);
  for (const json& line : lines()) EXPECT_EQ(line["scene"], "./a.gltf");
  EXPECT_EQ(other.uploads, 1);
  EXPECT_EQ(server.uploads, 2);
}

TEST_F(SweepTest, ANameThatIsNotThereIsNoMissingScene) {
  written("a.gltf", "{}");
  const std::string local = written("local.textproto", R"(group { scene: "./a.gltf" view { name: "nowhere" }
    size { width: 8 height: 8 } method { name: "sm" } })");
  server.judge = [](const v1::RenderRequest& request) {
    return request.view_name() == "nowhere" ? grpc::Status(grpc::NOT_FOUND, "view_name is 'nowhere'")
                                            : grpc::Status::OK;
  };
  EXPECT_EQ(sundial({"--server", addressOf(server), "sweep", local, "-o", results}).status, 1);
  EXPECT_EQ(lines()[0]["error"]["message"], "view_name is 'nowhere'");
  EXPECT_LE(server.uploads, 1);
}

TEST_F(SweepTest, KeepsSmallPictures) {
  const std::string big =
      written("big.textproto", R"(group { scene: "builtin:discs" size { width: 1300 height: 700 }
    method { name: "sm" parameter { key: "texels" value: "64" } } method { name: "ray-traced" } })");
  const Outcome outcome =
      sundial({"--server", addressOf(server), "sweep", big, "-o", results, "--images", path("p")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::set<std::string> named;
  for (const json& line : lines())
    for (const char* kind : {"picture", "error", "plan"}) {
      const std::string name = line["images"][kind];
      EXPECT_EQ(name.find("p/" + line["case"].get<std::string>()), 0u) << name;
      EXPECT_GT(fs::file_size(folder.path() / name), 100u);
      EXPECT_LT(fs::file_size(folder.path() / name), 30'000u) << name;
      named.insert(fs::path(name).filename().string());
    }
  std::set<std::string> there;
  for (const auto& entry : fs::directory_iterator(folder.path() / "p"))
    there.insert(entry.path().filename().string());
  EXPECT_EQ(there, named);
}

}  // namespace
}  // namespace sundial::test
