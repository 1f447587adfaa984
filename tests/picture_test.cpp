// What the client draws: error overlays, plans over light space, the chart of error against time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <regex>
#include <set>

#include "image/overlay.h"
#include "page/base64.h"
#include "page/chart.h"
#include "page/light_space.h"
#include "page/plan_picture.h"
#include "page/units.h"

namespace sundial {
namespace {

client::Image floats(v1::Aov aov, unsigned width, unsigned height, const std::vector<float>& values) {
  std::string bytes(values.size() * 4, '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return {aov, width, height, bytes};
}

image::Rgb pixel(const image::Picture& picture, unsigned index) {
  const auto* p = &picture.pixels[picture.channels * index];
  return {p[0], p[1], p[2]};
}
bool same(image::Rgb a, image::Rgb b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

TEST(Overlay, ColoursWrongPixelsAndDimsTheRest) {
  const client::Image colour{v1::COLOUR, 5, 1, std::string(20, '\xff')};
  // right lit, right dark, false lit, false shadow, and a half, which counts as lit
  const auto s = floats(v1::VISIBILITY, 5, 1, {1, 0, 1, 0, 0.5f}),
             r = floats(v1::REFERENCE, 5, 1, {1, 0, 0, 1, 1});
  const image::Picture overlay = image::errorOverlay(colour, s, r);
  for (const unsigned right : {0u, 1u, 4u}) {
    const image::Rgb grey = pixel(overlay, right);
    EXPECT_TRUE(grey.r == grey.g && grey.g == grey.b && grey.r < 128) << right;
  }
  EXPECT_TRUE(same(pixel(overlay, 2), image::kFalseLit));
  EXPECT_TRUE(same(pixel(overlay, 3), image::kFalseShadow));
}

TEST(Overlay, LayerIsOpaqueOnlyWhereItIsWrong) {
  std::vector<float> s(25, 1), r(25, 1);
  r[12] = 0;
  const image::Picture layer =
      image::errorLayer(floats(v1::VISIBILITY, 5, 5, s), floats(v1::REFERENCE, 5, 5, r));
  EXPECT_EQ(layer.channels, 4u);
  for (unsigned i = 0; i < 25; ++i) {
    const bool near = i / 5 >= 1 && i / 5 <= 3 && i % 5 >= 1 && i % 5 <= 3;
    const int alpha = layer.pixels[4 * i + 3];
    EXPECT_EQ(alpha == 255, i == 12) << i;
    EXPECT_EQ(alpha > 0, near) << i;
  }
  EXPECT_TRUE(same(pixel(layer, 12), image::kFalseLit));
}

// Whatever the hues look like to a reader, lightness alone tells them apart and from the dimmed picture.
TEST(Overlay, ColoursDifferInLightnessForAnyColourVision) {
  const auto lightness = [](image::Rgb colour) {
    const auto linear = [](int v) { return std::pow(v / 255.0, 2.2); };
    const double y = 0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b);
    return 116 * std::cbrt(y) - 16;
  };
  EXPECT_GT(std::abs(lightness(image::kFalseLit) - lightness(image::kFalseShadow)), 15);
  EXPECT_GT(std::min(lightness(image::kFalseLit), lightness(image::kFalseShadow)), 45);
}

std::vector<double> numbers(const std::string& svg, const std::string& pattern) {
  std::vector<double> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator it(svg.begin(), svg.end(), expression), end; it != end; ++it)
    found.push_back(std::stod((*it)[1]));
  return found;
}

constexpr const char* kMarkX = R"re(translate\(([0-9.]+),[0-9.]+\)" fill)re";
constexpr const char* kMarkY = R"re(translate\([0-9.]+,([0-9.]+)\)" fill)re";

TEST(Chart, PlacesMarksOnLogarithmicAxes) {
  const std::string svg =
      page::errorChart({{"a", "a", 1, 0, 0, 0.1}, {"b", "b", 10, 0, 0, 0.01}, {"c", "c", 100, 0, 0, 0.001}});
  const auto x = numbers(svg, kMarkX), y = numbers(svg, kMarkY);
  ASSERT_EQ(x.size(), 3u);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.2);  // a decade is a decade
  EXPECT_NEAR(y[1] - y[0], y[2] - y[1], 0.2);
  EXPECT_GT(x[1], x[0]);
  EXPECT_GT(y[1], y[0]);  // less error is lower
  for (const char* text : {"[ms]", "% of pixels with geometry", ">a</text>"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(Chart, ZeroErrorHasABandBelowEveryOther) {
  const std::string svg = page::errorChart({{"map", "map", 5, 4, 6, 1e-7}, {"exact", "exact", 50, 0, 0, 0}});
  const auto y = numbers(svg, kMarkY);
  ASSERT_EQ(y.size(), 2u);
  EXPECT_GT(y[1], y[0]);
  EXPECT_NE(svg.find("class=\"band\""), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_EQ(page::errorChart({{"map", "map", 5, 0, 0, 0.1}}).find("class=\"band\""), std::string::npos);
}

TEST(Chart, AllExactOrUntimedIsNoAccident) {
  const std::string exact = page::errorChart({{"exact", "exact", 5, 0, 0, 0}});
  EXPECT_EQ(exact.find("nan"), std::string::npos);
  EXPECT_EQ(numbers(exact, kMarkX).size(), 1u);
  EXPECT_NE(page::errorChart({{"a", "a", 0, 0, 0, 0.1}}).find("No times"), std::string::npos);
}

TEST(Chart, ShapesTellEightMethodsApart) {
  std::vector<page::ChartPoint> points;
  for (int i = 0; i < 8; ++i)
    points.push_back({fmt::format("m{}", i), fmt::format("f{}", i), 1.0 + i, 0, 0, 0.1});
  const std::string svg = page::errorChart(points);
  std::set<std::string> shapes;
  const std::regex expression(R"re(<path d="([^"]+)" transform)re");
  for (std::sregex_iterator it(svg.begin(), svg.end(), expression), end; it != end; ++it)
    shapes.insert((*it)[1]);
  EXPECT_EQ(shapes.size(), 8u);
}

v1::Light sun() {
  v1::Light light;
  light.mutable_sun()->mutable_direction()->set_y(-2);
  return light;
}

// Looks straight down on x in [0, 20], z in [-5, 5].
v1::PlanView viewFromAbove() {
  v1::PlanView view;
  for (const double value : {0.1, 0., 0., -1., 0., 0., 0.2, 0., 0., 0.05, 0., 0.5, 0., 0., 0., 1.})
    view.add_shadow_from_world(value);
  for (const unsigned value : {0u, 0u, 512u, 256u}) view.add_rect(value);
  view.set_texel_size(0.0390625);
  return view;
}

TEST(LightSpace, MeasuresTheSunsPlaneInMetres) {
  v1::Plan plan;
  plan.add_views()->set_empty(true);
  *plan.add_views() = viewFromAbove();
  const auto space = page::LightSpace::of(sun(), plan);
  ASSERT_TRUE(space);
  const auto outline = space->outline(plan.views(1));
  ASSERT_TRUE(outline);
  EXPECT_NEAR(glm::distance((*outline)[0], (*outline)[1]), 20, 1e-9);
  EXPECT_NEAR(glm::distance((*outline)[1], (*outline)[2]), 10, 1e-9);
  // Height doesn't matter; the map's right is right and its down is down.
  EXPECT_NEAR(glm::distance(*space->project({3, 7, 2}), *space->project({3, -9, 2})), 0, 1e-9);
  EXPECT_GT(space->project({4, 0, 0})->x, space->project({3, 0, 0})->x);
  EXPECT_GT(space->project({0, 0, 4})->y, space->project({0, 0, 3})->y);
}

TEST(LightSpace, MeasuresASpotByTangents) {
  v1::Light light;
  light.mutable_spot()->mutable_eye()->set_y(10);
  light.mutable_spot()->mutable_target()->set_y(0);
  light.mutable_spot()->set_cone_degrees(90);
  v1::Plan plan;
  v1::PlanView& view = *plan.add_views();
  for (const double value : {1., 0., 0., 0., 0., 0., 1., 0., 0., 0., 0., 0.1, 0., -1., 0., 10.})
    view.add_shadow_from_world(value);
  const auto space = page::LightSpace::of(light, plan);
  ASSERT_TRUE(space);
  EXPECT_NEAR(space->project({5, 0, 0})->x, 0.5, 1e-9);
  EXPECT_FALSE(space->project({5, 11, 0}));
  EXPECT_NEAR(glm::distance((*space->outline(view))[0], (*space->outline(view))[1]), 2, 1e-9);
}

TEST(PlanPicture, LabelsResolutionsAndNotesTheirAbsence) {
  client::MethodRendering rendering;
  EXPECT_NE(page::planPicture(rendering, sun()).find("no plan"), std::string::npos);
  *rendering.plan.add_views() = viewFromAbove();
  rendering.images.push_back({v1::COLOUR, 2, 1, std::string(8, '\xff')});
  rendering.images.push_back(floats(v1::POSITION, 2, 1, {1, 2, 3, 4, 5, 6}));
  EXPECT_NE(page::planPicture(rendering, sun()).find("512×256 texels of 39.1 mm"), std::string::npos);
  v1::Light point;
  point.mutable_point();
  EXPECT_NE(page::planPicture(rendering, point).find("no one plane"), std::string::npos);
}

TEST(Units, SayWhatTheyMean) {
  EXPECT_EQ(page::percent(0), "0 %");
  EXPECT_EQ(page::percent(0.00027), "0.0270 %");
  EXPECT_EQ(page::bytes(16.0 * 1024 * 1024), "16.0 MiB");
  EXPECT_EQ(page::bytes(12), "12 B");
  EXPECT_EQ(page::length(0.0098), "9.80 mm");
  EXPECT_EQ(page::escaped("<a href='x'>&"), "&lt;a href=&#39;x&#39;&gt;&amp;");
  EXPECT_EQ(page::dataUri("t/t", "Man"), "data:t/t;base64,TWFu");
  EXPECT_EQ(page::dataUri("t/t", "Ma"), "data:t/t;base64,TWE=");
  EXPECT_EQ(page::dataUri("t/t", "M"), "data:t/t;base64,TQ==");
}

}  // namespace
}  // namespace sundial
