// `chart`: results are merged and refused as its help says; the table and the front are right.
#include "chart/results.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "chart/csv.h"
#include "chart/front.h"
#include "fake_server.h"
#include "process.h"

namespace sundial::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json line(const std::string& id, const std::string& method, double ratio, double match) {
  return {
      {"case", id},
      {"scene", "builtin:discs"},
      {"view_name", "front"},
      {"light_name", "sun"},
      {"size", {96, 64}},
      {"device", "a device"},
      {"driver", "its driver"},
      {"baseline", "sm,texels=2048"},
      {"repetitions", 5},
      {"method", method},
      {"parameters", {{"texels", "512x512"}, {"bias", "2"}}},
      {"frame_ms", 10 * ratio},
      {"frame_quartiles", {9 * ratio, 11 * ratio}},
      {"ratio_to_baseline", ratio},
      {"ratio_quartiles", {0.9 * ratio, 1.1 * ratio}},
      {"measures",
       {{"pixel_match", match},
        {"false_lit", 0.0},
        {"false_shadow", 0.0},
        {"mean_abs_error", 0.0},
        {"interior_error", 0.0},
        {"edge_error_px", {{"p50", 1}, {"p95", 2}, {"max", 3}}},
        {"total_bytes", 1048576}}},
      {"passes", {{{"name", "store"}, {"gpu_ms", 4.5}, {"quartiles", {4, 5}}, {"work", {{"vertices", 7}}}}}},
      {"plan", {{"views", {json::object()}}}}};
}

class ChartTest : public testing::Test {
 protected:
  TemporaryFolder folder;

  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
    return folder.path() / name;
  }
  std::string why(const std::string& text) {
    try {
      chart::readResults({write("bad.jsonl", text)});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  }
};

TEST_F(ChartTest, MergesFilesAndTheLastOfOneCaseCounts) {
  const auto results = chart::readResults(
      {write("a", line("1", "sm", 1, 0.9).dump() + "\n" + line("2", "dv", 1, 0.9).dump() + "\n"),
       write("b", line("1", "sm", 2, 0.8).dump() + "\n\n")});
  ASSERT_EQ(results.cases.size(), 2u);
  EXPECT_EQ(results.cases[0].method, "dv");  // in order of names
  EXPECT_EQ(results.cases[1].id, "1");
  EXPECT_EQ(results.cases[1].ratio.median, 2);
  EXPECT_EQ(results.cases[1].ratio.lower, 1.8);
  EXPECT_EQ(results.cases[1].passes.at(0).work.at("vertices"), 7);
  ASSERT_EQ(results.remarks.size(), 1u);
  EXPECT_NE(results.remarks[0].find("repeat"), std::string::npos);
}

TEST_F(ChartTest, IgnoresATornLastLine) {
  const std::string whole = line("1", "sm", 1, 0.9).dump() + "\n";
  const auto results = chart::readResults({write("torn", whole + whole.substr(0, 100))});
  EXPECT_EQ(results.cases.size(), 1u);
  ASSERT_EQ(results.remarks.size(), 1u);
  EXPECT_NE(results.remarks[0].find("torn:2: ignored"), std::string::npos);
}

TEST_F(ChartTest, KeepsALastLineThatOnlyLacksItsEnd) {
  EXPECT_EQ(chart::readResults({write("a", line("1", "sm", 1, 0.9).dump())}).cases.size(), 1u);
}

TEST_F(ChartTest, RefusesWhatIsNoResultWithFileAndLine) {
  const std::string whole = line("1", "sm", 1, 0.9).dump() + "\n";
  EXPECT_NE(why(whole + "{\"case\": \n" + whole).find("bad.jsonl:2"), std::string::npos);
  EXPECT_NE(why("some text\n").find("bad.jsonl:1"), std::string::npos);
  EXPECT_NE(why("[1]\n").find("no JSON object"), std::string::npos);
  json broken = line("1", "sm", 1, 0.9);
  broken.erase("measures");
  EXPECT_NE(why(broken.dump()).find("no 'measures'"), std::string::npos);
  broken = line("1", "sm", 1, 0.9);
  broken["ratio_quartiles"] = {1};
  EXPECT_NE(why(broken.dump()).find("'ratio_quartiles'"), std::string::npos);
  broken["ratio_quartiles"] = "no";
  EXPECT_NE(why(broken.dump()).find("'ratio_quartiles'"), std::string::npos);
  broken = line("1", "sm", 1, 0.9);
  broken["size"] = {-1, 5};
  EXPECT_NE(why(broken.dump()).find("'size'"), std::string::npos);
}

TEST_F(ChartTest, LabelsNameTheParametersThatDiffer) {
  json other = line("2", "sm", 1, 0.9), failed = line("3", "sm", 1, 0.9);
  other["parameters"]["texels"] = "1024x512";
  failed["parameters"] = {{"texels", "512x512"}};  // only what was asked for
  failed["error"] = {{"code", "CANCELLED"}, {"message", "it was cancelled"}};
  const auto cases =
      chart::readResults({write("a", line("1", "sm", 1, 0.9).dump() + "\n" + other.dump() + "\n" +
                                         failed.dump() + "\n" + line("4", "dv", 1, 1).dump())})
          .cases;
  ASSERT_EQ(cases.size(), 4u);
  EXPECT_EQ(cases[0].label, "dv");
  EXPECT_EQ(cases[1].label, "sm,texels=512");
  EXPECT_EQ(cases[2].label, "sm,texels=512");
  EXPECT_EQ(cases[2].failed->code, "CANCELLED");
  EXPECT_EQ(cases[3].label, "sm,texels=1024x512");
}

TEST(ChartFrontTest, HasStrictlyLessErrorWithTime) {
  EXPECT_EQ(chart::paretoFront({{3, 0}, {1, 5}, {2, 5}, {2, 2}, {2, 2}, {4, 1}, {5, 0}}),
            (std::vector<std::size_t>{1, 3, 0}));
  EXPECT_TRUE(chart::paretoFront({}).empty());
}

TEST_F(ChartTest, CsvQuotesWhatItMust) {
  json odd = line("1", "sm", 1, 0.9), failed = line("2", "dv", 1, 1);
  odd["device"] = "a \"fine\" device,\nreally";
  failed["error"] = {{"code", "INTERNAL"}, {"message", "x"}};
  const std::string csv =
      chart::csvOf(chart::readResults({write("a", odd.dump() + "\n" + failed.dump() + "\n")}).cases);
  EXPECT_NE(csv.find("\"a \"\"fine\"\" device,\nreally\",its driver,\"sm,texels=2048\""), std::string::npos)
      << csv;
  EXPECT_NE(csv.find("parameter.texels"), std::string::npos);
  EXPECT_NE(csv.find(",,,,INTERNAL,x\r\n"), std::string::npos) << csv;
  EXPECT_TRUE(csv.ends_with(",1,4.5,,\r\n")) << csv;  // on the front, its pass, no error
}

// A still case may be of a view of the same name.
TEST_F(ChartTest, ACaseAlongAPathIsItsOwnConfiguration) {
  json moved = line("1", "sm", 1, 0.9);
  moved["view_name"] = "";
  moved["motion"] = {{"path_name", "front"}, {"light_path_name", ""}, {"frames", 24}};
  moved["stability"] = {{"flip_rate", 0.0},   {"pop", 0.125},   {"texel_jump", 2.5},
                        {"wrong_rate", 0.25}, {"points", 2000}, {"frames", 24}};
  const auto cases =
      chart::readResults({write("a", moved.dump() + "\n" + line("2", "sm", 1, 0.9).dump())}).cases;
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].view, "along front");
  EXPECT_EQ(cases[1].view, "front");
  ASSERT_TRUE(cases[0].stability);
  EXPECT_FALSE(cases[1].stability);
  EXPECT_EQ(cases[0].stability->pop, 0.125);
  const std::string csv = chart::csvOf(cases);
  EXPECT_NE(csv.find("flip_rate,pop,texel_jump,points_wrong,points,frames,on_front"), std::string::npos)
      << csv;
  EXPECT_NE(csv.find(",0,0.125,2.5,0.25,2000,24,1,4.5"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",,,,,,,1,4.5"), std::string::npos) << csv;  // the still one

  const fs::path svg = folder.path() / "figures";
  ASSERT_EQ(sundial({"chart", (folder.path() / "a").string(), "-o", (folder.path() / "p.html").string(),
                     "--svg", svg.string()})
                .status,
            0);
  EXPECT_NE(
      contents((svg / "stability-builtin-discs-along-front-sun-96x64.svg").string()).find("class=\"band\""),
      std::string::npos);  // of zeros
  EXPECT_FALSE(fs::exists(svg / "stability-builtin-discs-front-sun-96x64.svg"));
}

TEST_F(ChartTest, TheCommandWritesAllThatIsAsked) {
  const fs::path out = folder.path() / "page.html", csv = folder.path() / "t.csv",
                 svg = folder.path() / "figures";
  json named = line("1", "sm<b>", 1, 0.9);
  named["images"] = {{"picture", "absent.png"}, {"plan", "plan.svg"}};
  write("plan.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
  const fs::path results = write("r.jsonl", named.dump() + "\n" + line("2", "exact", 3, 1).dump() + "\n");
  const Outcome outcome =
      sundial({"chart", results.string(), "-o", out.string(), "--csv", csv.string(), "--svg", svg.string(),
               "--credit", "Discs by <Nobody>", "--credit", "and others"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("1 of the pictures"), std::string::npos);
  const std::string page = contents(out.string());
  EXPECT_NE(page.find("Discs by &lt;Nobody&gt;"), std::string::npos);
  EXPECT_NE(page.find("and others"), std::string::npos);
  EXPECT_EQ(page.find("sm<b>"), std::string::npos);
  EXPECT_NE(page.find("sm\\u003cb>"), std::string::npos);
  EXPECT_NE(page.find("Redistribution and use"), std::string::npos);  // Vega's licence
  EXPECT_FALSE(std::regex_search(page, std::regex("<link|<script src|@import|fetch\\(['\"]")));
  EXPECT_EQ(std::distance(fs::directory_iterator(svg), {}), 3);
  const std::string figure = contents((svg / "error-time-builtin-discs-front-sun-96x64.svg").string());
  EXPECT_NE(figure.find("class=\"front\""), std::string::npos);
  EXPECT_EQ(figure.find("var("), std::string::npos);
  EXPECT_NE(contents(csv.string()).find("sm<b>"), std::string::npos);
}

TEST_F(ChartTest, TheCommandRefusesInOneLine) {
  const auto refused = [&](const std::vector<std::string>& arguments, std::string_view what) {
    const Outcome outcome = sundial(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  };
  const std::string good = write("good", line("1", "sm", 1, 0.9).dump() + "\n").string();
  const std::string out = (folder.path() / "x.html").string();
  refused({"chart", (folder.path() / "none").string(), "-o", out}, "none can't be read");
  refused({"chart", write("text", "hello\n").string(), "-o", out}, "text:1: ");
  refused({"chart", write("empty", "").string(), "-o", out}, "no result");
  refused({"chart", good, "-o", (folder.path() / "no" / "x.html").string()}, "-o: there is no folder");
  refused({"chart", good, "-o", out, "--csv", folder.path().string()}, "--csv: ");
  refused({"chart", good, "-o", out, "--svg", good}, "--svg: ");
  refused({"chart", good}, "--output is required");
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(ChartTest, TheSameResultsInAnyOrderWriteTheSamePage) {
  const std::string one = line("1", "sm", 1, 0.9).dump() + "\n", two = line("2", "dv", 2, 1).dump() + "\n";
  const std::string good = write("good", one + two).string(), swapped = write("swapped", two + one).string();
  const std::string a = (folder.path() / "a.html").string(), b = (folder.path() / "b.html").string();
  ASSERT_EQ(sundial({"chart", good, "-o", a}).status, 0);
  ASSERT_EQ(sundial({"chart", swapped, "-o", b}).status, 0);
  EXPECT_EQ(contents(a), contents(b));
}

}  // namespace
}  // namespace sundial::test
