// `sundial stability` and the real server: paths by name and from files, every named case, the page; and what
// the client makes of streams and of cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "command/verdict.h"
#include "fake_server.h"
#include "process.h"
#include "stability/cases.h"
#include "sundial/stability.h"

namespace sundial::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class StabilityCommandTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = std::make_unique<TemporaryFolder>();
    address = "unix:" + (folder->path() / "socket").string();
    server.emplace(SUNDIALD, std::vector<std::string>{"--listen", address, "--validation"});
    waitForServer(address);
  }
  static void TearDownTestSuite() {
    server->signal(SIGTERM);
    const Outcome outcome = server->wait();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("vulkan:"), std::string::npos) << outcome.err;
    server.reset();
    folder.reset();
  }

  static Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--server", address, "stability"});
    return sundial(arguments);
  }
  static std::string written(const std::string& name, const std::string& text) {
    const fs::path path = folder->path() / name;
    std::ofstream(path) << text;
    return path.string();
  }
  static void expectRefused(const std::vector<std::string>& arguments, int status, const std::string& words) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }

  static std::unique_ptr<TemporaryFolder> folder;
  static std::string address;
  static std::optional<Process> server;
};
std::unique_ptr<TemporaryFolder> StabilityCommandTest::folder;
std::string StabilityCommandTest::address;
std::optional<Process> StabilityCommandTest::server;

const std::vector<std::string> kSmall{"--size", "96x96", "--points", "800"};

std::vector<std::string> with(std::vector<std::string> first, const std::vector<std::string>& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

TEST_F(StabilityCommandTest, APathOfTheScene) {
  const Outcome outcome = run(with({"builtin:grid", "--method", "sm,texels=256", "--method", "dv,texels=256",
                                    "--method", "ray-traced", "--path", "orbit", "--frames", "5", "--json"},
                                   kSmall));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  ASSERT_EQ(report["cases"].size(), 1u);
  const json& only = report["cases"][0];
  EXPECT_EQ(only["case"], "orbit");
  const json& results = only["results"];
  ASSERT_EQ(results.size(), 3u);
  EXPECT_EQ(results[0]["method"], "sm");
  EXPECT_EQ(results[0]["flip_rate"], 0.0);
  EXPECT_EQ(results[0]["pop"], 0.0);
  EXPECT_GT(results[1]["flip_rate"], 0.0);
  EXPECT_GE(results[1]["pop"], results[1]["flip_rate"]);
  EXPECT_GT(results[1]["texel_jump"], 0.0);
  EXPECT_EQ(results[2]["flip_rate"], 0.0);
  for (const json& result : results) {
    EXPECT_EQ(result["flips_per_frame"].size(), 5u);
    EXPECT_EQ(result["plan_jumps"].size(), 5u);
    EXPECT_EQ(result["points"], 800.0);
  }
}

TEST_F(StabilityCommandTest, PathsFromFiles) {
  const std::string camera = written("turn.txtpb",
                                     "keys { eye { x: 6 y: 5 z: 6 } target {} vertical_fov_degrees: 50 }\n"
                                     "keys { eye { x: 5 y: 5 z: 7 } target {} vertical_fov_degrees: 50 }\n"
                                     "frames: 4\n");
  const std::string light = written("day.txtpb",
                                    "keys { sun { direction { x: -1 y: -1 } } }\n"
                                    "keys { sun { direction { y: -1 z: -0.5 } } }\nframes: 9\n");
  const Outcome outcome = run(
      with({"builtin:grid", "--method", "sm,texels=256", "--path", camera, "--light-path", light, "--json"},
           kSmall));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json only = json::parse(outcome.out)["cases"][0];
  EXPECT_EQ(only["case"], "turn");
  EXPECT_EQ(only["results"][0]["flips_per_frame"].size(), 4u);
  EXPECT_GT(only["results"][0]["flip_rate"], 0.0);
}

TEST_F(StabilityCommandTest, APageOfACase) {
  const fs::path out = folder->path() / "cases";
  const Outcome outcome = run({"--case", "dv-turn", "--quiet", "-o", out.string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = contents((out / "index.html").string());
  EXPECT_NE(page.find("dv-turn"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos) << "the page needs no network";
  EXPECT_TRUE(fs::exists(out / "dv-turn-1-dv-texels-512.png"));
  EXPECT_TRUE(fs::exists(out / "report.json"));
}

class NamedCase : public StabilityCommandTest, public testing::WithParamInterface<std::string_view> {};

TEST_P(NamedCase, IsAsItMustBe) {
  const Outcome outcome = run({"--case", std::string(GetParam()), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  ASSERT_EQ(report["cases"].size(), 1u);
  const json& one = report["cases"][0];
  EXPECT_EQ(one["verdict"]["good"], true) << one["verdict"]["why"];
  for (const json& result : one["results"])
    for (const char* measure : {"flip_rate", "pop", "texel_jump", "wrong_rate", "wrong_pixels"})
      EXPECT_TRUE(result[measure].is_number()) << measure;
}

std::vector<std::string_view> caseNames() {
  std::vector<std::string_view> names;
  for (const StabilityCase& one : stabilityCases()) names.push_back(one.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, NamedCase, testing::ValuesIn(caseNames()), [](const auto& info) {
  std::string name(info.param);
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST_F(StabilityCommandTest, ACaseTakesMoreMethods) {
  const Outcome outcome = run({"--case", "no-receiver", "--method", "sm,lookup=pcf", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["cases"][0]["results"].size(), 4u);
}

TEST_F(StabilityCommandTest, BadRequestsAreOneLine) {
  expectRefused({}, 2, "SCENE");
  expectRefused({"builtin:grid", "--path", "orbit"}, 2, "--method");
  expectRefused({"builtin:grid", "--method", "sm"}, 2, "nothing moves");
  expectRefused({"builtin:grid", "--method", "sm", "--path", "orbit", "--view", "main"}, 2, "stand still");
  expectRefused({"builtin:grid", "--case", "dv-pan"}, 2, "--case");
  expectRefused({"builtin:grid", "--method", "sm", "--path", "./absent.txtpb"}, 2, "./absent.txtpb");
  expectRefused({"builtin:grid", "--method", "sm", "--path", written("bad.txtpb", "keys {\n eyes: 1 }")}, 2,
                "line 2");
  expectRefused({"builtin:grid", "--method", "sm", "--path", "nowhere"}, 1, "orbit");
  expectRefused({"--case", "nonesuch"}, 1, "dv-turn");
}

// --- Streams

v1::StabilityEvent frameEvent(std::uint32_t flips) {
  v1::StabilityEvent event;
  event.mutable_frame()->set_frames(2);
  event.mutable_frame()->set_flips(flips);
  return event;
}

v1::StabilityRequest smallRequest() {
  v1::StabilityRequest request;
  request.set_width(1);
  request.set_height(1);
  request.add_methods()->set_name("sm");
  return request;
}

TEST(StabilityStream, IsBelievedOnlyWhole) {
  v1::StabilityEvent accepted, outcome, done;
  accepted.mutable_accepted();
  outcome.mutable_outcome()->mutable_result()->set_method("sm");
  done.mutable_done();
  {
    client::StabilityAssembler assembler(smallRequest());
    for (const auto& event : {accepted, frameEvent(0), frameEvent(1), outcome, done})
      EXPECT_TRUE(assembler.add(event).ok());
    EXPECT_EQ(assembler.framesDone(), assembler.frames());
    EXPECT_TRUE(assembler.finish());
  }
  for (const auto& events : {std::vector{accepted, outcome}, {accepted, done}, {}}) {
    client::StabilityAssembler assembler(smallRequest());
    for (const auto& event : events) EXPECT_TRUE(assembler.add(event).ok());
    const auto finished = assembler.finish();
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().code, grpc::DATA_LOSS);
  }
  client::StabilityAssembler assembler(smallRequest());
  EXPECT_FALSE(assembler.add(outcome).ok());
}

TEST(StabilityStream, DamagedPicturesAreRefused) {
  v1::StabilityEvent accepted, begin, chunk, end;
  accepted.mutable_accepted();
  begin.mutable_picture_begin()->set_width(1);
  begin.mutable_picture_begin()->set_height(1);
  begin.mutable_picture_begin()->set_bytes(4);
  chunk.mutable_image_chunk()->set_data("abcd");
  end.mutable_image_end()->set_crc32c(0x92c80a31);  // CRC-32C of "abcd"
  const auto last = [&](const std::vector<v1::StabilityEvent>& events) {
    client::StabilityAssembler assembler(smallRequest());
    grpc::Status status;
    for (const auto& event : events) status = assembler.add(event);
    return status;
  };
  EXPECT_TRUE(last({accepted, begin, chunk, end}).ok());
  EXPECT_FALSE(last({accepted, begin, end}).ok());
  EXPECT_FALSE(last({accepted, begin, chunk, chunk}).ok());
  EXPECT_FALSE(last({accepted, begin, frameEvent(0)}).ok());
  EXPECT_FALSE(last({accepted, chunk}).ok());
  end.mutable_image_end()->set_crc32c(1);
  EXPECT_FALSE(last({accepted, begin, chunk, end}).ok());
  begin.mutable_picture_begin()->set_width(2);
  EXPECT_FALSE(last({accepted, begin}).ok());
}

// --- Verdicts

v1::StabilityReport::Case resultsOf(std::initializer_list<double> rates) {
  v1::StabilityReport::Case report;
  for (const double rate : rates) report.add_results()->set_flip_rate(rate);
  return report;
}

TEST(CaseVerdict, TellsApartByAFactorOfThree) {
  v1::StabilityCase row;
  row.set_measure("flip_rate");
  row.set_tells_apart(true);
  row.set_fails_above(0.01);
  const auto verdict = [&](double fails, double cures) {
    return command::judge(row, resultsOf({fails, cures}).results(), {});
  };
  EXPECT_TRUE(verdict(0.03, 0.01).good());
  EXPECT_DOUBLE_EQ(verdict(0.03, 0.01).factor(), 3);
  EXPECT_FALSE(verdict(0.029, 0.01).good());
  EXPECT_FALSE(verdict(0.009, 0).good());
  EXPECT_TRUE(verdict(0.01, 0).good());
  EXPECT_FALSE(verdict(std::numeric_limits<double>::quiet_NaN(), 0).good());
  EXPECT_FALSE(verdict(0.03, std::numeric_limits<double>::infinity()).good());
}

TEST(CaseVerdict, BoundsEveryMethodByItsTwin) {
  v1::StabilityCase row;
  row.set_measure("flip_rate");
  row.set_at_most(0.001);
  EXPECT_TRUE(command::judge(row, resultsOf({0.001, 0}).results(), {}).good());
  EXPECT_FALSE(command::judge(row, resultsOf({0, 0.0011}).results(), {}).good());
  const auto twin = resultsOf({0.1, 0});
  EXPECT_TRUE(command::judge(row, resultsOf({0.12, 0}).results(), twin.results()).good());
  EXPECT_FALSE(command::judge(row, resultsOf({0.13, 0}).results(), twin.results()).good());
}

}  // namespace
}  // namespace sundial::test
