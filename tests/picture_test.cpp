// What the client draws: error overlays, plans over light space, the chart of error against time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <regex>
#include <set>

#include "image/overlay.h"
#include "image/view_colour.h"
#include "image/view_tint.h"
#include "page/base64.h"
#include "page/chart.h"
#include "page/light_space.h"
#include "page/plan_labels.h"
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

// Faces that look along x and along -x from (0, 10, 0), each with a rim.
TEST(LightSpace, LaysTheFacesAboutAPointSideBySide) {
  v1::Light light;
  light.mutable_point()->mutable_position()->set_y(10);
  v1::Plan plan;
  for (const double sign : {1., -1.}) {
    v1::PlanView& view = *plan.add_views();
    for (const double value : {0., 0., 0.8 * sign, 0., 0., -0.8, 0., 8., 0., 0., 0., 0.1, sign, 0., 0., 0.})
      view.add_shadow_from_world(value);
  }
  const auto space = page::LightSpace::of(light, plan);
  ASSERT_TRUE(space);
  EXPECT_FALSE(space->metres());
  EXPECT_NEAR(glm::distance(*space->project({4, 10, 2}), {0.5, 0}), 0, 1e-9);
  EXPECT_NEAR(glm::distance(*space->project({4, 8, 0}), {0, 0.5}), 0, 1e-9);
  const auto outline = *space->outline(plan.views(1));
  EXPECT_NEAR(glm::distance(*space->project({-4, 10, 0}), 0.5 * (outline[0] + outline[2])), 0, 1e-9);
  EXPECT_NEAR(glm::distance(outline[0], outline[1]), 2.5, 1e-9);
  EXPECT_GT(outline[0].x, space->outline(plan.views(0))->at(1).x) << "beside each other";
}

// From above and aside.
v1::View camera() {
  v1::View view;
  view.mutable_eye()->set_y(10);
  view.mutable_target()->set_x(10);
  view.set_vertical_fov_degrees(40);
  return view;
}

std::string bytesOf(std::initializer_list<std::uint32_t> values) {
  std::string bytes(values.size() * 4, '\0');
  std::memcpy(bytes.data(), std::data(values), bytes.size());
  return bytes;
}

constexpr std::uint32_t kNoView = 0xffffffff;

TEST(PlanPicture, LabelsResolutionsAndNotesTheirAbsence) {
  client::MethodRendering rendering;
  EXPECT_NE(page::planPicture(rendering, camera(), sun()).find("no plan"), std::string::npos);
  *rendering.plan.add_views() = viewFromAbove();
  rendering.plan.mutable_views(0)->set_depth_end(8);
  const std::string svg = page::planPicture(rendering, camera(), sun());
  for (const char* text : {">512×256<", ">view 0 · 39.1 mm<", ">0–8.00 m<", "class=\"frustum\""})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  v1::Light point;
  point.mutable_point();
  EXPECT_NE(page::planPicture(rendering, camera(), point).find("no one plane"), std::string::npos);
}

// Of four samples at one place: seen by a view, two that face away from the light, and lit because no map
// holds it.
TEST(PlanPicture, LeavesOutSamplesThatFaceAwayFromTheLight) {
  client::MethodRendering rendering;
  *rendering.plan.add_views() = viewFromAbove();
  rendering.images = {{v1::COLOUR, 4, 1, std::string(16, '\xff')},
                      floats(v1::POSITION, 4, 1, {3, 0, 1, 3, 0, 1, 3, 0, 1, 3, 0, 1}),
                      floats(v1::VISIBILITY, 4, 1, {0, 0, 0, 1}),
                      {v1::VIEW, 4, 1, bytesOf({0, kNoView, kNoView, kNoView})}};
  EXPECT_NE(page::planPicture(rendering, camera(), sun()).find(">2</text>"), std::string::npos);
}

TEST(PlanPicture, DashesEmptyTilesAndLeavesOutEmptyPartitionsThatHaveNoPlace) {
  client::MethodRendering rendering;
  for (int i = 0; i < 3; ++i) *rendering.plan.add_views() = viewFromAbove();
  rendering.plan.mutable_views(1)->set_empty(true);
  rendering.plan.mutable_views(1)->add_tile(0);
  rendering.plan.mutable_views(1)->add_tile(1);
  rendering.plan.mutable_views(2)->set_empty(true);
  const std::string svg = page::planPicture(rendering, camera(), sun());
  EXPECT_NE(svg.find("stroke-dasharray=\"5 5\""), std::string::npos);
  EXPECT_NE(svg.find("view 1 · empty"), std::string::npos);
  EXPECT_EQ(svg.find("view 2 ·"), std::string::npos);
  EXPECT_NE(svg.find("without samples: view 2<"), std::string::npos);
}

bool overlap(const page::Box& a, const page::Box& b) {
  return glm::all(glm::lessThan(a.least, b.most - 0.01)) && glm::all(glm::lessThan(b.least, a.most - 0.01));
}

void expectApart(const std::vector<page::LabelWish>& wishes) {
  const auto labels = page::placeLabels(wishes);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    ASSERT_TRUE(labels[i]) << i;
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(labels[i]->box.least, wishes[i].room.least - 0.01))) << i;
    EXPECT_TRUE(glm::all(glm::lessThanEqual(labels[i]->box.most, wishes[i].room.most + 0.01))) << i;
    // Room for the letters, by a width that usual fonts keep to.
    for (std::size_t line = 0; line < labels[i]->lines.size(); ++line)
      EXPECT_GE(labels[i]->box.size().x, 0.57 * (line == 0 ? 1 : page::kSmallerFont) * labels[i]->fontSize *
                                             static_cast<double>(labels[i]->lines[line].size()))
          << i;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(overlap(labels[i]->box, labels[j]->box)) << i << ' ' << j;
  }
}

TEST(PlanLabels, KeepToTheirTilesOfFourByFour) {
  std::vector<page::LabelWish> wishes;
  for (int i = 0; i < 16; ++i) {
    const glm::dvec2 corner = 36.0 + 162.0 * glm::dvec2(i % 4, i / 4);
    wishes.push_back({{corner, corner + 162.0}, {"1024", fmt::format("view {}: 39.3 cm", i)}});
  }
  expectApart(wishes);
  for (const auto& label : page::placeLabels(wishes)) EXPECT_EQ(label->lines.size(), 2u);
}

TEST(PlanLabels, OfCascadesInsideOfEachOtherKeepApart) {
  std::vector<page::LabelWish> wishes;
  for (const double side : {60., 150., 340., 640.})
    wishes.push_back({{glm::dvec2(36), glm::dvec2(36 + side)}, {"1024", "view 0: 39.3 cm", "1.00-2.00 m"}});
  expectApart(wishes);
}

TEST(PlanLabels, AreDroppedWhereTheyDontFit) {
  EXPECT_FALSE(page::placeLabels({{{glm::dvec2(0), glm::dvec2(20)}, {"1024", "view 0"}}})[0]);
}

TEST(ViewTint, HasTheColoursOfThePlanOnWhite) {
  const client::Image colour{v1::COLOUR, 3, 1, std::string(12, '\xff')};
  const image::Picture tint = image::viewTint(colour, {v1::VIEW, 3, 1, bytesOf({0, 9, kNoView})});
  EXPECT_TRUE(same(pixel(tint, 0), image::viewColour(0)));
  EXPECT_TRUE(same(pixel(tint, 1), image::viewColour(9)));
  const image::Rgb none = pixel(tint, 2);
  EXPECT_TRUE(none.r == none.g && none.g == none.b);
}

// View 0 answers in a strip that is too thin for its number, view 7 in the rest.
TEST(ViewTint, WritesNumbersWhereTheyFit) {
  const unsigned side = 64;
  std::string views;
  for (unsigned i = 0; i < side * side; ++i) views += bytesOf({i % side < 4 ? 0u : 7u});
  const image::Picture tint = image::viewTint({v1::COLOUR, side, side, std::string(4 * side * side, '\x7f')},
                                              {v1::VIEW, side, side, views});
  unsigned inStrip = 0, inRest = 0;
  for (unsigned i = 0; i < side * side; ++i)
    if (same(pixel(tint, i), {255, 255, 255})) ++(i % side < 4 ? inStrip : inRest);
  EXPECT_EQ(inStrip, 0u);
  EXPECT_EQ(inRest, 4u * 11);  // a 7 has eleven dots, of 2 x 2 pixels
}

// As readers without receptors for red or for green see them: both become one mixture of the two [Vienot,
// Brettel and Mollon 1999].
TEST(ViewColour, FirstFourDifferForAnyColourVision) {
  for (const glm::dvec3& mixture : {glm::dvec3(0.11238, 0.88762, 0), glm::dvec3(0.29275, 0.70725, 0)}) {
    const auto seen = [&](std::size_t view) {
      const image::Rgb c = image::viewColour(view);
      const glm::dvec3 linear = glm::pow(glm::dvec3(c.r, c.g, c.b) / 255.0, glm::dvec3(2.2));
      return glm::pow(glm::dvec2(glm::dot(mixture, linear), linear.b), glm::dvec2(1 / 2.2));
    };
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b) EXPECT_GT(glm::distance(seen(a), seen(b)), 0.2) << a << ' ' << b;
  }
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
