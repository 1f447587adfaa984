// Warps: functions that rise, an inverse that is one, running sums as a plain loop has them, and maps drawn
// through the inverse, where large triangles stay straight.
#include <algorithm>
#include <cmath>

#include "bench/tessellated_store.h"
#include "support/warped.h"

namespace sundial::test {
namespace {

using glm::dvec2;

// Ground of so many squares a side, and a curtain of two triangles above it.
std::shared_ptr<const Scene> curtain(int squares = 1) {
  SceneBuilder builder("curtain");
  builder.addMaterial({.gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  const auto quad = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    const auto mesh = builder.addMesh("quad", {{.positions = {a, b, c, d}, .indices = {0, 1, 2, 0, 2, 3}}});
    builder.addInstance("quad", mesh, glm::dmat4(1));
  };
  const float side = 120 / float(squares);
  const glm::vec3 x(side, 0, 0), z(0, 0, side);
  for (int row = 0; row < squares; ++row)
    for (int column = 0; column < squares; ++column) {
      const glm::vec3 corner = glm::vec3(-60, 0, -60) + float(column) * x + float(row) * z;
      quad(corner, corner + z, corner + x + z, corner + x);
    }
  quad({-25, 1, -6}, {25, 1, 14}, {25, 9, 14}, {-25, 9, -6});
  return sharedScene(std::move(builder).finish());
}
const View kBesideTheCurtain{.eye = {-9, 1.7, 12}, .target = {2, 0.5, -6}, .verticalFovDegrees = 60};

struct Place {
  std::string scene, view, light;
};
const std::vector<Place> kPlaces = {
    {"atrium", "main", "sun"}, {"observatory", "main", "spot"}, {"trees?count=40", "walk", "low"}};

TEST_F(FrameWarp, EveryFunctionRisesFromRimToRimAndTheInverseIsOne) {
  for (const Place& p : kPlaces)
    for (const char* text : {"rtw,texels=200x120", "notw,texels=200x120",
                             "notw,texels=128,window=1,even=0.05", "rtw,texels=64,weights=1:1:2:0:1,window=3",
                             "rtw,texels=64,analysis=forward", "rtw,texels=96x64,analysis=hybrid"}) {
      SCOPED_TRACE(p.scene + " " + text);
      const auto scene = builtin(p.scene);
      const Warped w = warp(scene, viewOf(*scene, p.view), lightOf(*scene, p.light), {300, 200}, text);
      expectWarp(w, 0.99 * method(text).settings.even);
    }
}

TEST_F(FrameWarp, UniformSamplesAreLeftWhereTheyAre) {
  const View above{.eye = {-20, 40, -20}, .target = {-20, 0, -20}, .up = {0, 0, 1}, .verticalFovDegrees = 20};
  for (const char* text : {"notw,texels=64,even=0.01,window=1", "rtw,texels=64,even=0.01,window=1"}) {
    const Warped w = warp(curtain(), above, {.direction = {0, -1, 0}}, {1024, 1024}, text);
    for (unsigned y = 0; y < w.size.y; ++y)
      for (unsigned x = 0; x < w.size.x; ++x) {
        const dvec2 p(x + 0.5, y + 0.5);
        ASSERT_LT(glm::length(w(p) - p), 1.5) << text << " " << x << " " << y;  // the border holds none
      }
  }
}

TEST_F(FrameWarp, RunningSumsAreThoseOfAPlainLoop) {
  struct Case {
    std::shared_ptr<const Scene> scene;
    View view;
    Light light;
    glm::uvec2 image;
    std::string texels;
    int window;
  };
  const auto atrium = builtin("atrium");
  std::vector<Case> cases;
  for (const int window : {1, 9, 33, 1000})
    cases.push_back({atrium, viewOf(*atrium, "main"), lightOf(*atrium, "sun"), {400, 300}, "96x64", window});
  // Sums above 2^32.
  cases.push_back({curtain(), kBesideTheCurtain, sun(60, 75), {2048, 1024}, "16", 32768});
  for (const Case& c : cases) {
    const Warped w = warp(c.scene, c.view, c.light, c.image,
                          fmt::format("notw,texels={},power=1,even=0.25,window={}", c.texels, c.window));
    const std::vector<double> counts = countsBefore(w);
    const int reach = c.window / 2;
    double worst = 0, most = 0;
    for (int row = 0; row < int(w.size.y); ++row) {
      std::vector<double> sums(w.size.x + 1);
      for (unsigned x = 0; x < w.size.x; ++x) {
        sums[x + 1] = sums[x];
        for (int r = row - reach; r <= row + reach; ++r)
          if (r >= 0 && r < int(w.size.y))
            sums[x + 1] += (reach + 1 - std::abs(r - row)) * counts[unsigned(r) * w.size.x + x];
        most = std::max(most, sums[x + 1] - sums[x]);
      }
      for (unsigned x = 0; x <= w.size.x && sums.back() > 100 * (reach + 1); ++x)
        worst = std::max(worst, std::abs(0.25 * x + 0.75 * w.size.x * sums[x] / sums.back() -
                                         double(w.across(std::size_t(row))[x])));
    }
    EXPECT_LT(worst, 0.5) << c.window << ": a sample on a border may count for either texel";
    EXPECT_EQ(most > 4294967296.0, c.window == 32768);
  }
}

TEST_F(FrameWarp, WideWindowsConvergeToARectilinearWarp) {
  const auto scene = builtin("atrium");
  const auto differs = [&](unsigned window) {
    const Warped w = warp(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {400, 300},
                          fmt::format("notw,texels=128,window={}", window));
    double most = 0;
    for (std::size_t f = 1; f < w.rows; ++f)
      for (unsigned k = 0; k <= w.size.x; ++k)
        most = std::max(most, double(std::abs(w.across(f)[k] - w.across(0)[k])));
    for (std::size_t f = 1; f < w.columns; ++f)
      for (unsigned k = 0; k <= w.size.y; ++k)
        most = std::max(most, double(std::abs(w.down(f)[k] - w.down(0)[k])));
    return most;
  };
  EXPECT_GT(differs(10), 5) << "texels";
  const double wide = differs(2048), wider = differs(4096), widest = differs(32768);
  EXPECT_LT(wide, 5);
  EXPECT_NEAR(wider, wide / 2, wide / 10);
  EXPECT_NEAR(widest, wide / 16, wide / 50);
}

TEST_F(FrameWarp, SamplesSpreadEvenlyAndFewerPixelsAreWrong) {
  const std::vector<Place> places = {
      {"atrium", "main", "sun"}, {"observatory", "main", "spot"}, {"conference", "main", "spot"}};
  for (const Place& p : places) {
    SCOPED_TRACE(p.scene);
    const auto scene = builtin(p.scene);
    const View view = viewOf(*scene, p.view);
    const Light light = lightOf(*scene, p.light);
    const auto spread = [&](std::string_view text, unsigned side) {
      const Warped w = warps(scene, view, light, {1024, 1024}, text, side).front();
      return bench::variation(countsAfter(w)) / bench::variation(countsBefore(w));
    };
    EXPECT_LT(spread("notw,texels=256,power=0.7,even=0.01,window=18", 1), 1.0 / 3);
    // With two or three samples to a texel the pixels' own grid varies more than that.
    constexpr std::string_view kEven = "notw,texels=512,power=0.7,even=0.01,window=36";
    EXPECT_LT(spread(kEven, 4), 1.0 / 3);
    const auto found = render(jobOf(scene, view, light, {1024, 1024},
                                    {kEven, "notw,texels=512", "rtw,texels=512", "sm,texels=512"}, {}, true));
    const auto match = [&](std::size_t m) { return found[m].result.measures->pixelMatch; };
    EXPECT_GT(match(0), match(2));
    EXPECT_GT(match(1), match(2));
    EXPECT_GT(match(2), match(3));
  }
}

// Leaves are holes of an alpha-tested material, whose coordinates must be right in a spot light's
// perspective.
TEST_F(FrameWarp, AWarpThatMovesNothingAnswersAsNoWarpDoes) {
  const auto atrium = builtin("atrium");
  for (const char* light : {"sun", "spot"}) {
    const auto wrong = [&](std::string_view text) {
      const Rendering r = render(atrium, viewOf(*atrium, "main"), lightOf(*atrium, light), {400, 300}, text);
      return 1 - r.result.measures->pixelMatch;
    };
    const double plain = wrong("dv,texels=512");
    EXPECT_NEAR(wrong("rtw,texels=512,even=1"), plain, 0.05 * plain) << light;
    EXPECT_NEAR(wrong("notw,texels=512,even=1"), plain, 0.05 * plain) << light;
  }
}

TEST_F(FrameWarp, WhateverIsAnalysedFewerPixelsAreWrong) {
  const auto scene = builtin("conference");
  const auto wrong = [&](std::string_view text) {
    const Rendering r = render(scene, viewOf(*scene, "main"), lightOf(*scene, "spot"), {512, 512}, text);
    return 1 - r.result.measures->pixelMatch;
  };
  const double plain = wrong("sm,texels=256"), backward = wrong("rtw,texels=256");
  EXPECT_LT(backward, plain);
  EXPECT_LT(wrong("rtw,texels=256,analysis=forward"), plain);
  EXPECT_LT(wrong("rtw,texels=256,analysis=hybrid"), plain);
  EXPECT_LT(wrong("notw,texels=256"), backward);
}

// A fence near the camera and the village behind it share rows and columns of the light's map. Looked for
// from the light, shadows' edges are important in all of them.
TEST_F(FrameWarp, RegionsThatShareRowsAndColumnsWasteARectilinearMapAndNoOther) {
  const auto scene = builtin("village");
  const auto wrong = [&](std::string_view text) {
    const Rendering r = render(scene, viewOf(*scene, "fence"), lightOf(*scene, "sun"), {512, 512}, text);
    return 1 - r.result.measures->pixelMatch;
  };
  EXPECT_GT(wrong("rtw,texels=512,analysis=forward"), 3 * wrong("notw,texels=512"));
}

// lavapipe ends an invocation after 65,535 rounds of its loops, whatever it has done by then.
TEST_F(FrameWarp, LargeMapsAreFinished) {
  const auto scene = builtin("grid");
  const auto wrong = [&](std::string_view text) {
    const Rendering r = render(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {256, 256}, text);
    return 1 - r.result.measures->pixelMatch;
  };
  const double plain = wrong("sm,texels=1024");
  for (const char* text : {"rtw", "rtw,texels=4096", "rtw,window=32768", "rtw,texels=4096,analysis=forward",
                           "rtw,analysis=hybrid", "notw"})
    EXPECT_LT(wrong(text), plain) << text;
}

// Above the middle of the map hangs a plate; the light's map shows its rim, which a camera that sees the
// ground on both sides of it can't tell from anything else.
TEST_F(FrameWarp, OnlyTheLightsMapTellsWhereShadowsEdgesAre) {
  SceneBuilder builder("plate");
  builder.addMaterial({.gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  const auto square = [&](float half, float y) {
    const auto mesh = builder.addMesh(
        "square", {{.positions = {{-half, y, -half}, {-half, y, half}, {half, y, half}, {half, y, -half}},
                    .indices = {0, 1, 2, 0, 2, 3}}});
    builder.addInstance("square", mesh, glm::dmat4(1));
  };
  square(60, 0);
  square(4, 30);
  const auto scene = sharedScene(std::move(builder).finish());
  const View below{
      .eye = {-20, 20, -20}, .target = {-20, 0, -20}, .up = {0, 0, 1}, .verticalFovDegrees = 110};
  // How wide the plate's columns become.
  const auto stretch = [&](std::string_view text) {
    const Warped w = warp(scene, below, {.direction = {0, -1, 0}}, {256, 256}, text);
    double most = 0;
    for (unsigned k = 0; k < w.size.x; ++k)
      most = std::max(most, double(w.across(0)[k + 1] - w.across(0)[k]));
    return most;
  };
  const char* kEdges = "rtw,texels=128,window=1,weights=0:0:0:1:0.001";
  const double backward = stretch(kEdges);
  EXPECT_GT(stretch(fmt::format("{},analysis=forward", kEdges)), 2 * backward);
  EXPECT_GT(stretch(fmt::format("{},analysis=hybrid", kEdges)), 2 * backward);
}

TEST_F(FrameWarp, ACurtainOfTwoTrianglesBendsInTheVertexShaderAndNotInTheInverse) {
  const auto scene = curtain();
  const Light light = sun(40, 75);
  for (const char* row : {"rtw", "notw"}) {
    const auto interior = [&](std::string_view more) {
      const Rendering r =
          render(scene, kBesideTheCurtain, light, {400, 300}, fmt::format("{},texels=512{}", row, more));
      return r.result.measures->interiorError;
    };
    EXPECT_LT(interior(""), 0.001) << row;
    EXPECT_GT(interior(",raster=pipeline"), 0.02) << row;
  }
}

// The papers' remedy: pieces of the curtain bend less, and some of it is left.
TEST_F(FrameWarp, TessellationLeavesSomeOfWhatTheVertexShaderBends) {
  if (!device().hasTessellationShaders()) GTEST_SKIP() << "no tessellation shaders";
  const bench::FrameScene seen = sight(curtain(60), kBesideTheCurtain, sun(40, 75), {400, 300});
  for (const char* row : {"rtw", "notw"}) {
    const auto wrong = [&](std::string_view raster, MakeStore* make) {
      const auto frame = seen.frame(fmt::format("{},texels=512,raster={}", row, raster), make);
      const std::vector<float> found = seen.visibility(), truth = seen.reference();
      double sum = 0;
      for (std::size_t i = 0; i < found.size(); ++i) sum += std::abs(found[i] - truth[i]);
      return sum / double(found.size());
    };
    const double bent = wrong("pipeline", makeStore), inverse = wrong("compute", makeStore);
    const double pieces = wrong("pipeline", bench::makeTessellated<8>);
    EXPECT_LT(pieces, bent / 2) << row;
    EXPECT_GT(pieces, 20 * inverse) << row;
  }
}

}  // namespace
}  // namespace sundial::test
