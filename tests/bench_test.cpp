// sundial-bench's words and lines: refused by itself, and the contract's names in its JSON.
#include "bench/json.h"
#include "bench/options.h"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "sundial/v1/sundial.pb.h"

namespace sundial::bench {
namespace {

Result<std::variant<Options, Answer>> parse(std::vector<const char*> words) {
  words.insert(words.begin(), "sundial-bench");
  return parseOptions(static_cast<int>(words.size()), words.data());
}

TEST(BenchOptions, RefusesWhatCanNeverWorkInOneLine) {
  const std::vector<std::vector<const char*>> wrong = {{"--method", "nothing"},
                                                       {"--method", "sm,texels=0"},
                                                       {"--baseline", "no"},
                                                       {"--size", "12"},
                                                       {"--size", "0x5"},
                                                       {"--sun", "1,2"},
                                                       {"--sun", "0,0,0"},
                                                       {"--fov", "3"},
                                                       {"--eye", "1,2,3"},
                                                       {"--repetitions", "0"},
                                                       {"--view", "a", "--eye", "1,2,3"}};
  for (const auto& words : wrong) {
    const auto parsed = parse(words);
    ASSERT_FALSE(parsed) << words[0] << " " << words[1];
    EXPECT_EQ(parsed.error().message.find('\n'), std::string::npos) << parsed.error().message;
  }
}

TEST(BenchOptions, EveryRowUnlessMethodsAreNamed) {
  const auto all = parse({});
  ASSERT_TRUE(all);
  EXPECT_EQ(std::get<Options>(*all).job.methods.size(), methodTable().size());
  const auto two = parse({"--method", "dv", "--method", "sm,texels=64", "--sun", "-0.5,-0.8,0.3"});
  ASSERT_TRUE(two);
  EXPECT_EQ(std::get<Options>(*two).job.methods.size(), 2u);
  EXPECT_EQ(std::get<Options>(*two).light->direction, glm::dvec3(-0.5, -0.8, 0.3));
}

// A line holds a Report's fields and a Result's: each name must be one of the contract's, with its type.
TEST(BenchJson, HasTheContractsNamesAndTypes) {
  RenderJob job;
  job.baseline = *parseMethod("sm,texels=2048");
  MethodResult result{.method = *parseMethod("dv"),
                      .ratio = Quartiles{1, 2, 3},
                      .measures = Measures{},
                      .passes = {{"store", {1, 2, 3}, {{"vertices", 3}}}},
                      .plan = {PlanView{.gpu = {}, .tile = glm::uvec2(2, 1)}, PlanView{.gpu = {}}}};
  result.plan[0].gpu.linearOffset = 64;
  result.plan[1].gpu.depthEnd = 8;
  for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
    job.light.kind = kind;
    const std::string line = toJson({"builtin:grid", "sm,texels=2048", {"device", "driver"}, job}, result);
    // The fields of a Report come first.
    const auto cut = line.find(",\"method\":");
    ASSERT_NE(cut, std::string::npos);
    const std::string report = fmt::format("{}}}", line.substr(0, cut));
    const std::string row = fmt::format("{{{}", line.substr(cut + 1));

    v1::Report first;
    v1::Result second;
    using google::protobuf::util::JsonStringToMessage;
    EXPECT_TRUE(JsonStringToMessage(report, &first).ok()) << JsonStringToMessage(report, &first);
    EXPECT_TRUE(JsonStringToMessage(row, &second).ok()) << JsonStringToMessage(row, &second);
    EXPECT_EQ(first.size(0), 1024u);
    EXPECT_EQ(first.baseline(), "sm,texels=2048");
    EXPECT_EQ(second.method(), "dv");
    EXPECT_EQ(second.ratio_to_baseline(), 2);
    ASSERT_EQ(second.plan().views_size(), 2);
    EXPECT_EQ(second.plan().views(0).tile(0), 2u);
    EXPECT_EQ(second.plan().views(0).tile(1), 1u);
    EXPECT_EQ(second.plan().views(0).linear_offset(), 64u);
    EXPECT_EQ(second.plan().views(1).tile_size(), 0);
    EXPECT_EQ(second.plan().views(1).depth_end(), 8);
    EXPECT_EQ(second.passes(0).work().at("vertices"), 3);
  }
}

}  // namespace
}  // namespace sundial::bench
