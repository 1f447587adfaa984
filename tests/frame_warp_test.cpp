// Warps: functions that rise, an inverse that is one, running sums as a plain loop has them, and maps drawn
// through the inverse, where large triangles stay straight.
#include <algorithm>
#include <cmath>

#include "shadow/camera.h"
#include "shadow/frame.h"
#include "shadow/frame_runner.h"
#include "support/rendering.h"

namespace sundial::test {
namespace {

using glm::dvec2;
using glm::dvec3;

// Ground, and a curtain of two triangles above it.
std::shared_ptr<const Scene> curtain() {
  SceneBuilder builder("curtain");
  builder.addMaterial({.gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  const auto quad = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    const auto mesh = builder.addMesh("quad", {{.positions = {a, b, c, d}, .indices = {0, 1, 2, 0, 2, 3}}});
    builder.addInstance("quad", mesh, glm::dmat4(1));
  };
  quad({-60, 0, -60}, {-60, 0, 60}, {60, 0, 60}, {60, 0, -60});
  quad({-25, 1, -6}, {25, 1, 14}, {25, 9, 14}, {-25, 9, -6});
  return sharedScene(std::move(builder).finish());
}
const View kBesideTheCurtain{.eye = {-9, 1.7, 12}, .target = {2, 0.5, -6}, .verticalFovDegrees = 60};

// What a frame leaves on the device, on the host; and the warp as warp.glsl has it.
struct Warped {
  glm::uvec2 size{0};
  std::size_t rows = 1, columns = 1;  // functions across and down
  std::vector<float> tables;          // pairs
  std::vector<float> values;          // of functions: the first of each pair behind the centres
  std::vector<dvec2> samples;         // positions in the map before the warp, texels

  const float* across(std::size_t row) const { return &values[row * (size.x + 1)]; }
  const float* down(std::size_t column) const { return across(rows) + column * (size.y + 1); }
  dvec2 centre(unsigned x, unsigned y) const {
    if (rows == 1) return {tables[2 * x], tables[2 * (size.x + y)]};
    const float* at = &tables[2 * (y * size.x + x)];
    return {at[0], at[1]};
  }
  static double valueAt(const float* table, double position, unsigned last) {
    const double at = std::clamp(position, 0.0, double(last));
    const auto k = std::min(static_cast<unsigned>(at), last - 1);
    return std::lerp(double(table[k]), double(table[k + 1]), at - k);
  }
  template <class Table>
  static double between(Table table, std::size_t count, double beside, double position, unsigned last) {
    const double at = std::clamp(beside - 0.5, 0.0, double(count - 1));
    const auto first = static_cast<std::size_t>(at);
    return std::lerp(valueAt(table(first), position, last),
                     valueAt(table(std::min(first + 1, count - 1)), position, last), at - double(first));
  }
  dvec2 operator()(const dvec2& p) const {
    const double x = between([&](std::size_t f) { return across(f); }, rows, p.y, p.x, size.x);
    return {x, between([&](std::size_t f) { return down(f); }, columns, x, p.y, size.y)};
  }
};

// Samples in each texel, row by row.
std::vector<double> countsOf(const std::vector<dvec2>& positions, const glm::uvec2& size) {
  std::vector<double> counts(std::size_t{size.x} * size.y);
  for (const dvec2& p : positions) {
    const glm::uvec2 texel = glm::min(glm::uvec2(p), size - 1u);
    ++counts[std::size_t{texel.y} * size.x + texel.x];
  }
  return counts;
}

double variation(const std::vector<double>& counts) {
  double sum = 0, squares = 0;
  for (const double c : counts) sum += c, squares += c * c;
  const double mean = sum / double(counts.size());
  return std::sqrt(squares / double(counts.size()) - mean * mean) / mean;
}

class FrameWarp : public RendererTest {
 protected:
  static Warped warp(const std::shared_ptr<const Scene>& scene, const View& view, Light light,
                     const glm::uvec2& image, std::string_view text) {
    static const auto device = [] {
      auto made = Device::create("", true);
      if (!made) throw std::runtime_error(made.error().message);
      return std::move(*made);
    }();
    static FramePipelines pipelines(*device);
    SceneBuffers buffers(*device, scene);
    const ViewTarget target(*device, image);
    const dvec3 origin = frameOrigin(*scene, view);
    buffers.moveTo(*device, origin);
    light.direction = glm::normalize(light.direction);
    const FrameView frameView{.device = *device,
                              .pipelines = pipelines,
                              .scene = buffers,
                              .target = target,
                              .reference = nullptr,
                              .light = light,
                              .origin = origin,
                              .constants = frameConstants(*scene, view, light, image, origin)};
    const Method chosen = method(text);
    Frame frame(frameView, chosen);
    if (const auto run = runFrame(*device, frame.passes(), {}); !run)
      throw std::runtime_error(run.error().message);

    const shared::Plan plan = frame.downloadPlan();
    const bool each = chosen.stages->warp == Warp::nonOrthogonal;
    Warped out{.size = plan.views[0].rectSize,
               .rows = each ? plan.views[0].rectSize.y : 1,
               .columns = each ? plan.views[0].rectSize.x : 1,
               .tables = frame.downloadWarp(),
               .values = {},
               .samples = {}};
    const std::size_t centres = each ? std::size_t{out.size.x} * out.size.y : out.size.x + out.size.y;
    for (std::size_t i = 2 * centres; i < out.tables.size(); i += 2) out.values.push_back(out.tables[i]);
    const auto positions = valuesOf<glm::uvec4>(downloaded(*device, target.positions, sizeof(glm::uvec4)));
    const auto normals = valuesOf<glm::uvec4>(downloaded(*device, target.normals, sizeof(glm::uvec4)));
    std::vector<shared::ViewSample> samples(positions.size());
    gatherSamples(positions.data(), normals.data(), samples);
    std::vector<std::uint8_t> faces(samples.size());
    facesLight(samples, light, origin, faces);
    const dvec2 low(plan.views[0].lsMin), high(plan.views[0].lsMax);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!faces[i]) continue;
      const glm::dvec4 ls = glm::dmat4(plan.lightFromWorld) * glm::dvec4(dvec3(samples[i].wsPosition), 1);
      const dvec2 share = (dvec2(ls) / ls.w - low) / (high - low);
      out.samples.push_back(dvec2(share.x, 1 - share.y) * dvec2(out.size));
    }
    EXPECT_EQ(device->validationMessages(), 0u);
    return out;
  }
  static std::vector<dvec2> moved(const Warped& w) {
    std::vector<dvec2> out;
    for (const dvec2& p : w.samples) out.push_back(w(p));
    return out;
  }
};

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
      const double least = 0.99 * method(text).settings.even;
      const auto expectRising = [&](const float* table, unsigned last) {
        EXPECT_EQ(table[0], 0);
        EXPECT_EQ(table[last], float(last));
        for (unsigned k = 0; k < last; ++k) ASSERT_GE(table[k + 1] - table[k], least) << k;
      };
      for (std::size_t f = 0; f < w.rows; ++f) expectRising(w.across(f), w.size.x);
      for (std::size_t f = 0; f < w.columns; ++f) expectRising(w.down(f), w.size.y);
      double worst = 0;
      for (unsigned y = 0; y < w.size.y; ++y)
        for (unsigned x = 0; x < w.size.x; ++x) {
          const dvec2 error = w(w.centre(x, y)) - dvec2(x + 0.5, y + 0.5);
          worst = std::max({worst, std::abs(error.x), std::abs(error.y)});
        }
      EXPECT_LT(worst, 5e-3) << "texels";
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
  const auto scene = builtin("atrium");
  for (const unsigned window : {1u, 9u, 33u, 1000u}) {
    const Warped w = warp(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {400, 300},
                          fmt::format("notw,texels=96x64,power=1,even=0.25,window={}", window));
    const std::vector<double> counts = countsOf(w.samples, w.size);
    double worst = 0;
    for (int row = 0; row < int(w.size.y); ++row) {
      std::vector<double> sums(w.size.x + 1);
      for (unsigned x = 0; x < w.size.x; ++x) {
        sums[x + 1] = sums[x];
        for (int r = row - int(window) / 2; r <= row + int(window) / 2; ++r)
          if (r >= 0 && r < int(w.size.y)) sums[x + 1] += counts[unsigned(r) * w.size.x + x];
      }
      for (unsigned x = 0; x <= w.size.x && sums.back() > 100; ++x)
        worst = std::max(worst, std::abs(0.25 * x + 0.75 * w.size.x * sums[x] / sums.back() -
                                         double(w.across(std::size_t(row))[x])));
    }
    EXPECT_LT(worst, 0.5) << window << ": a sample on a border may count for either texel";
  }
}

TEST_F(FrameWarp, TheWidestWindowIsRectilinear) {
  const auto scene = builtin("atrium");
  const auto of = [&](std::string_view text) {
    return warp(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {400, 300}, text);
  };
  const Warped wide = of("notw,texels=128,window=256"), narrow = of("notw,texels=128,window=5");
  const auto differs = [](const Warped& w) {
    double most = 0;
    for (std::size_t f = 1; f < w.rows; ++f)
      for (unsigned k = 0; k <= w.size.x; ++k)
        most = std::max(most, double(std::abs(w.across(f)[k] - w.across(0)[k])));
    for (std::size_t f = 1; f < w.columns; ++f)
      for (unsigned k = 0; k <= w.size.y; ++k)
        most = std::max(most, double(std::abs(w.down(f)[k] - w.down(0)[k])));
    return most;
  };
  EXPECT_LT(differs(wide), 1e-3);
  EXPECT_GT(differs(narrow), 5);
}

TEST_F(FrameWarp, SamplesSpreadOverTheTexels) {
  for (const Place& p : kPlaces) {
    const auto scene = builtin(p.scene);
    const auto of = [&](std::string_view text) {
      return warp(scene, viewOf(*scene, p.view), lightOf(*scene, p.light), {1024, 1024}, text);
    };
    const Warped w = of("notw,texels=256,power=1,even=0.05,window=5"), mild = of("notw,texels=256");
    const double before = variation(countsOf(w.samples, w.size)),
                 after = variation(countsOf(moved(w), w.size));
    const double afterMild = variation(countsOf(moved(mild), w.size));
    EXPECT_LT(after, before / 3) << p.scene;
    EXPECT_LT(afterMild, 0.7 * before) << p.scene;
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

}  // namespace
}  // namespace sundial::test
