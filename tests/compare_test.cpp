// `compare`: its document has the shape that DESIGN section 4 fixes, and its folder is complete.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "fake_server.h"
#include "process.h"

namespace sundial::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class CompareTest : public testing::Test {
 protected:
  FakeServer server;
  TemporaryFolder folder;

  Outcome compare(const std::vector<std::string>& more) {
    std::vector<std::string> all{"--server",     server.address(), "compare",    "builtin:discs", "--method",
                                 "sm,texels=64", "--method",       "ray-traced", "--size",        "96x64"};
    all.insert(all.end(), more.begin(), more.end());
    return sundial(all);
  }
};

std::set<std::string> keys(const json& object) {
  std::set<std::string> names;
  for (const auto& [name, value] : object.items()) names.insert(name);
  return names;
}

// Whatever DESIGN lists is there; more may be.
void expectKeys(const json& object, const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted)
    EXPECT_TRUE(object.contains(name)) << name << " in " << object.dump();
}

TEST_F(CompareTest, JsonHasTheShapeOfTheDesign) {
  const Outcome outcome = compare({"--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  EXPECT_EQ(keys(report), (std::set<std::string>{"scene", "view", "light", "size", "device", "driver",
                                                 "baseline", "results"}));
  EXPECT_EQ(report["scene"], "builtin:discs");
  EXPECT_EQ(report["size"], (json{96, 64}));
  EXPECT_EQ(report["device"], "fake device");
  EXPECT_EQ(report["baseline"], "sm,texels=2048");
  EXPECT_TRUE(report["view"]["eye"]["x"].is_number());
  EXPECT_TRUE(report["light"]["sun"].is_object());
  ASSERT_EQ(report["results"].size(), 2u);
  for (const json& result : report["results"]) {
    expectKeys(result, {"method", "parameters", "frame_ms", "ratio_to_baseline", "ratio_quartiles",
                        "measures", "passes", "plan"});
    EXPECT_EQ(result["ratio_quartiles"].size(), 2u);
    const json& measures = result["measures"];
    EXPECT_EQ(keys(measures),
              (std::set<std::string>{"pixel_match", "false_lit", "false_shadow", "mean_abs_error",
                                     "edge_error_px", "interior_error", "texel_px", "utilisation",
                                     "store_bytes", "total_bytes", "allocated_bytes"}));
    EXPECT_EQ(keys(measures["edge_error_px"]), (std::set<std::string>{"p50", "p95", "max"}));
    EXPECT_EQ(keys(measures["texel_px"]), (std::set<std::string>{"p50", "p95"}));
    for (const auto& [name, value] : measures.items())
      EXPECT_TRUE(value.is_number() || value.is_object()) << name;
    for (const json& pass : result["passes"]) {
      expectKeys(pass, {"name", "gpu_ms", "quartiles", "work"});
      EXPECT_TRUE(pass["work"]["fragments"].is_number());
    }
    EXPECT_TRUE(result["plan"]["views"].is_array());
  }
  EXPECT_EQ(report["results"][0]["plan"]["views"][0]["shadow_from_world"].size(), 16u);
  EXPECT_EQ(report["results"][1]["measures"]["false_lit"], 0.0);
}

TEST_F(CompareTest, TableNamesMethodsAndPasses) {
  const Outcome outcome = compare({});
  EXPECT_EQ(outcome.status, 0);
  for (const char* text :
       {"sm,texels=64", "ray-traced", "false shadow", "ratios to sm,texels=2048", "gbuffer 12.0"})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text;
}

TEST_F(CompareTest, FolderIsCompleteAndThePageSelfContained) {
  const fs::path out = folder.path() / "deep" / "out";
  const Outcome outcome = compare({"-o", out.string(), "--credit", "Discs by <Nobody>, CC-BY 4.0"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(out)) names.insert(entry.path().filename().string());
  EXPECT_EQ(names,
            (std::set<std::string>{"sm-texels-64.png", "sm-texels-64-visibility.png",
                                   "sm-texels-64-error.png", "sm-texels-64-plan.svg", "ray-traced.png",
                                   "ray-traced-visibility.png", "ray-traced-error.png", "ray-traced-plan.svg",
                                   "reference.png", "chart.svg", "report.json", "index.html"}));
  EXPECT_EQ(json::parse(contents((out / "report.json").string()))["results"].size(), 2u);
  const std::string page = contents((out / "index.html").string());
  EXPECT_NE(page.find("Discs by &lt;Nobody&gt;, CC-BY 4.0"), std::string::npos);
  EXPECT_NE(contents((out / "ray-traced-plan.svg").string()).find("no plan"), std::string::npos);
  // Nothing is fetched: every source is inside, and the only other addresses are namespaces.
  EXPECT_FALSE(std::regex_search(page, std::regex("src=\"(?!data:)")));
  EXPECT_FALSE(std::regex_search(page, std::regex("<link|url\\(|@import|fetch\\(")));
  std::string rest = page;
  for (std::size_t at; (at = rest.find("http://www.w3.org/2000/svg")) != std::string::npos;)
    rest.erase(at, 26);
  EXPECT_EQ(rest.find("http"), std::string::npos);
}

TEST_F(CompareTest, MethodsOfSeveralViewsShowWhichAnsweredInTheColoursOfThePlan) {
  const fs::path out = folder.path() / "out";
  ASSERT_EQ(compare({"--method", "csm,texels=64", "-o", out.string()}).status, 0);
  EXPECT_TRUE(fs::exists(out / "csm-texels-64-views.png"));
  EXPECT_FALSE(fs::exists(out / "sm-texels-64-views.png"));
  const std::string plan = contents((out / "csm-texels-64-plan.svg").string());
  const std::string page = contents((out / "index.html").string());
  for (const char* colour : {"#56b4e9", "#f0e442"}) {
    EXPECT_NE(plan.find(colour), std::string::npos) << colour;
    EXPECT_NE(page.find(colour), std::string::npos) << colour;
  }
  EXPECT_NE(page.find("<td>10.0–20.0 m</td>"), std::string::npos);
  EXPECT_NE(plan.find("depths 10.0–20.0 m"), std::string::npos);
}

TEST_F(CompareTest, TheSameRequestWritesTheSamePage) {
  ASSERT_EQ(compare({"-o", (folder.path() / "a").string()}).status, 0);
  ASSERT_EQ(compare({"-o", (folder.path() / "b").string()}).status, 0);
  for (const auto& entry : fs::directory_iterator(folder.path() / "a"))
    EXPECT_EQ(contents(entry.path().string()),
              contents((folder.path() / "b" / entry.path().filename()).string()))
        << entry.path();
}

TEST_F(CompareTest, AFailureWritesNothing) {
  server.tamper = [](const v1::RenderEvent& event) { return !event.has_done(); };
  const Outcome outcome = compare({"-o", (folder.path() / "out").string()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(fs::is_empty(folder.path() / "out"));
}

TEST_F(CompareTest, TwoOfOneLabelKeepTheirFilesApart) {
  const std::string out = (folder.path() / "out").string();
  ASSERT_EQ(compare({"--method", "ray-traced", "-o", out}).status, 0);
  EXPECT_TRUE(fs::exists(out + "/ray-traced-2.png"));
}

}  // namespace
}  // namespace sundial::test
