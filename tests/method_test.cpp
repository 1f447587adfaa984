// The table of methods: every row can be chosen, and what can't be is refused by name, with the reason and a
// way out.
#include "shadow/method.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "shadow/stages.h"

namespace sundial {
namespace {

using Parameters = std::map<std::string, std::string>;

// Expects a refusal that holds all of these words.
void expectRefused(const Result<Method>& result, ErrorCode code, std::initializer_list<std::string> words) {
  ASSERT_FALSE(result) << result->label();
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << result.error().message;
  for (const std::string& word : words)
    EXPECT_NE(result.error().message.find(word), std::string::npos)
        << "no \"" << word << "\" in: " << result.error().message;
}

// Read by lookup=evsm alone, which doesn't read those of bias.
bool readsMoments(std::string_view parameter) {
  return parameter == "exponents" || parameter == "blur" || parameter == "bleed_reduction" ||
         parameter == "least_deviation" || parameter == "anisotropy";
}

// Read by lookups that a row need not have.
bool readBySomeLookup(std::string_view parameter) {
  return parameter == "kernel" || parameter == "recovery" || parameter == "positions" ||
         parameter.starts_with("bias_");
}

// A value of the parameter that isn't its default.
std::string another(const Parameter& p) {
  for (const std::string_view choice : p.choices)
    if (choice != p.defaultValue) return std::string(choice);
  return "7";
}

TEST(MethodTable, NamesAreUniqueAndEveryRowHasItsSource) {
  std::set<std::string_view> names;
  for (const MethodRow& row : methodTable()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.title.empty()) << row.name;
    EXPECT_NE(row.source.find('['), std::string_view::npos) << row.name;
    EXPECT_EQ(row.stages.has_value(), row.technique == Technique::shadowMap) << row.name;
  }
  EXPECT_TRUE(names.contains("sm") && names.contains("dv") && names.contains("ray-traced"));
}

TEST(MethodTable, EveryRowsStagesGoTogether) {
  for (const MethodRow& row : methodTable())
    EXPECT_TRUE(!row.stages || !whyImpossible(*row.stages)) << row.name;
}

TEST(MethodTable, EveryRowIsChosenByItsNameWithItsDefaults) {
  for (const MethodRow& row : methodTable()) {
    const auto method = chooseMethod(row.name, {});
    ASSERT_TRUE(method) << method.error().message;
    EXPECT_EQ(method->row, &row);
    EXPECT_EQ(method->label(), row.name);
    for (const auto& [key, value] : method->parameters) {
      const auto given = chooseMethod(row.name, {{key, value}});
      ASSERT_TRUE(given) << given.error().message;
      EXPECT_EQ(given->parameters, method->parameters) << row.name << " " << key;
    }
    for (const Parameter& p : parametersOf(row))
      EXPECT_TRUE(method->parameters.contains(std::string(p.name)) || readsMoments(p.name) ||
                  readBySomeLookup(p.name) || p.name == "raster")
          << p.name;
  }
}

TEST(MethodTable, EveryParameterHasADefaultWithinItsRangeAndADescription) {
  for (const MethodRow& row : methodTable())
    for (const Parameter& p : parametersOf(row)) {
      EXPECT_FALSE(p.description.empty()) << p.name;
      EXPECT_FALSE(p.defaultValue.empty()) << p.name;
      EXPECT_TRUE(p.kind == Parameter::Kind::choice ? p.choices.size() > 1 : p.min < p.max) << p.name;
    }
}

TEST(MethodLabel, RoundTripsThroughParseMethod) {
  for (const MethodRow& row : methodTable()) {
    const auto plain = chooseMethod(row.name, {});
    EXPECT_EQ(parseMethod(plain->label())->parameters, plain->parameters);
    for (const Parameter& p : parametersOf(row)) {
      Parameters wanted{{std::string(p.name), another(p)}};
      if (p.name == "kernel") wanted["lookup"] = "pcf";
      if (readsMoments(p.name)) wanted.insert({{"storage", "moments"}, {"lookup", "evsm"}});
      const auto method = chooseMethod(row.name, wanted);
      if (!method) continue;  // a choice that needs another one: below
      const auto again = parseMethod(method->label());
      ASSERT_TRUE(again) << method->label() << ": " << again.error().message;
      EXPECT_EQ(again->parameters, method->parameters) << method->label();
      EXPECT_EQ(again->label(), method->label());
      EXPECT_NE(method->label(), row.name) << p.name;
    }
  }
}

TEST(MethodLabel, NamesWhatDiffersFromTheDefaults) {
  EXPECT_EQ(parseMethod("sm,texels=2048")->label(), "sm");
  EXPECT_EQ(parseMethod("sm,texels=1024,lookup=hard")->label(), "sm,texels=1024");
  EXPECT_EQ(parseMethod("sm,lookup=pcf,kernel=5,texels=1024x512")->label(),
            "sm,kernel=5,lookup=pcf,texels=1024x512");
}

TEST(ParseMethod, SettlesTheSettings) {
  const auto m = parseMethod("dv,texels=1024x512,bias_texels=0.25,bias_world=0.01,lookup=pcf,kernel=7");
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_EQ(m->settings.width, 1024u);
  EXPECT_EQ(m->settings.height, 512u);
  EXPECT_EQ(m->settings.biasTexels, 0.25);
  EXPECT_EQ(m->settings.biasWorld, 0.01);
  EXPECT_EQ(m->settings.kernel, 7u);
  EXPECT_EQ(m->stages->lookup, Lookup::pcf);
  EXPECT_FALSE(parseMethod("sm")->settings.biasWorld) << "auto";
}

TEST(ParseMethod, MakesARowIntoAnotherByItsStages) {
  const auto m = parseMethod("sm,volume=samples,focus=aabb");
  ASSERT_TRUE(m) << m.error().message;
  const Method desired = *chooseMethod("dv", {});
  const Stages& dv = *desired.stages;
  for (const std::string_view stage : stageNames())
    EXPECT_EQ(stageChoice(*m->stages, stage), stageChoice(dv, stage));
}

TEST(ParseMethod, RefusesAMethodThatIsNotThereAndNamesThoseThatAre) {
  for (const char* text : {"vsm", "", "SM", "sm ", ",texels=64"})
    expectRefused(parseMethod(text), ErrorCode::notFound, {"sm", "dv", "ray-traced", "choose"});
  expectRefused(parseMethod("vsm"), ErrorCode::notFound, {"\"vsm\""});
}

TEST(ParseMethod, RefusesAParameterThatIsNotThereAndNamesThoseThatAre) {
  expectRefused(parseMethod("sm,resolution_scale=2"), ErrorCode::invalidArgument,
                {"sm", "resolution_scale", "texels", "bias_texels", "lookup"});
  expectRefused(parseMethod("ray-traced,texels=64"), ErrorCode::invalidArgument,
                {"ray-traced", "no parameters", "texels"});
}

TEST(ParseMethod, RefusesValuesOutsideTheirRangeAndNamesTheRange) {
  for (const char* value : {"0", "15", "16385", "-1", "1024x0", "x", "64x", "64x64x64", "64.5", "", "1e3",
                            "99999999999999", "nan"})
    expectRefused(parseMethod(fmt::format("sm,texels={}", value)), ErrorCode::invalidArgument,
                  {"sm", fmt::format("texels={}", value), "[16, 16384] texels", "WIDTHxHEIGHT"});
  for (const char* value : {"-0.1", "101", "nan", "inf", "much", "", "1 "})
    expectRefused(parseMethod(fmt::format("dv,bias_texels={}", value)), ErrorCode::invalidArgument,
                  {"dv", "bias_texels", "[0, 100] texels"});
  expectRefused(parseMethod("sm,bias_world=none"), ErrorCode::invalidArgument,
                {"bias_world=none", "auto", " m"});
  for (const char* value : {"0", "16", "2.5", "three"})
    expectRefused(parseMethod(fmt::format("sm,lookup=pcf,kernel={}", value)), ErrorCode::invalidArgument,
                  {"kernel", "[1, 15] texels", "whole number"});
  expectRefused(parseMethod("sm,lookup=soft"), ErrorCode::invalidArgument,
                {"lookup=soft", "hard", "pcf", "choose"});
}

TEST(ParseMethod, TakesTheEndsOfEachRange) {
  for (const char* text : {"sm,texels=16", "sm,texels=16384", "sm,texels=16x16384", "sm,bias_texels=0",
                           "sm,bias_texels=100", "sm,bias_world=0", "sm,bias_world=1e6", "sm,bias_world=auto",
                           "sm,lookup=pcf,kernel=1", "sm,lookup=pcf,kernel=15"})
    EXPECT_TRUE(parseMethod(text)) << text;
}

TEST(ParseMethod, RefusesAParameterGivenTwice) {
  expectRefused(parseMethod("sm,texels=64,texels=64"), ErrorCode::invalidArgument, {"texels", "twice"});
}

TEST(ParseMethod, RefusesWhatIsNotKeyEqualsValue) {
  for (const char* text : {"sm,texels", "sm,", "sm,,texels=64", "sm,=64", "sm,texels=64,"})
    expectRefused(parseMethod(text), ErrorCode::invalidArgument, {"key=value"});
}

TEST(ParseMethod, RefusesAParameterThatNoStageReads) {
  expectRefused(parseMethod("sm,kernel=5"), ErrorCode::invalidArgument, {"sm", "kernel=5", "lookup=pcf"});
  expectRefused(parseMethod("dv,lookup=hard,kernel=5"), ErrorCode::invalidArgument,
                {"dv", "kernel=5", "lookup=pcf"});
}

TEST(ParseMethod, RefusesStagesThatDoNotGoTogetherWithTheReason) {
  expectRefused(parseMethod("sm,focus=aabb"), ErrorCode::invalidArgument,
                {"sm", "focus=aabb", "volume=samples"});
  expectRefused(parseMethod("dv,focus=loose"), ErrorCode::invalidArgument,
                {"dv", "volume=samples", "focus=aabb"});
  for (const char* text :
       {"sm,lookup=evsm", "sm,storage=moments", "sm,storage=moments,lookup=pcf", "evsm,lookup=hard"})
    expectRefused(parseMethod(text), ErrorCode::invalidArgument, {"storage=moments", "lookup=evsm"});
  expectRefused(parseMethod("iasm,storage=moments,lookup=evsm"), ErrorCode::invalidArgument,
                {"iasm", "storage=linear"});
}

TEST(ParseMethod, RefusesExponentsThatAreNotAPair) {
  for (const char* text : {"evsm,exponents=40", "evsm,exponents=40:5:1"})
    expectRefused(parseMethod(text), ErrorCode::invalidArgument, {"exponents", "40:5"});
  expectRefused(parseMethod("evsm,exponents=50:5"), ErrorCode::invalidArgument,
                {"exponents=50:5", "[0.1, 42]"});
}

TEST(Stages, AreSetByNameAndNothingElse) {
  Stages stages = *methodTable()[0].stages;
  for (const std::string_view stage : stageNames())
    for (const std::string_view choice : stageChoices(stage)) {
      EXPECT_TRUE(setStage(stages, stage, choice));
      EXPECT_EQ(stageChoice(stages, stage), choice);
      EXPECT_FALSE(setStage(stages, stage, "none of these"));
      EXPECT_EQ(stageChoice(stages, stage), choice) << "a refused choice changes nothing";
    }
  EXPECT_FALSE(setStage(stages, "colour", "red"));
  EXPECT_TRUE(stageChoices("colour").empty());
}

}  // namespace
}  // namespace sundial
