// Hulls, the smallest rectangles around them, solids cut by planes, and the light's smallest frustum that is
// made of them.
#include "shadow/minimal_frustum.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "scene/builtin/random.h"
#include "shadow/convex_hull.h"
#include "shadow/polytope.h"
#include "support/rendering.h"

namespace sundial::test {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

std::vector<dvec2> randomPoints(std::size_t count, std::uint64_t seed) {
  builtin::Random random(seed);
  std::vector<dvec2> points(count);
  // Long and turned, so that the rectangle matters.
  for (dvec2& p : points) {
    const dvec2 q(random.range(-5, 5), random.range(-1, 1));
    p = {0.8 * q.x - 0.6 * q.y + 100, 0.6 * q.x + 0.8 * q.y};
  }
  return points;
}

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

TEST(ConvexHull, HoldsAllPointsAndTurnsLeftAtEachCorner) {
  for (std::size_t count = 3; count < 200; count = count * 3 / 2) {
    const auto points = randomPoints(count, count);
    const auto hull = convexHull(points);
    ASSERT_GE(hull.size(), 3u);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const dvec2 &a = hull[i], &b = hull[(i + 1) % hull.size()], &c = hull[(i + 2) % hull.size()];
      EXPECT_GT(cross(b - a, c - b), 0);
      for (const dvec2& p : points) EXPECT_GE(cross(b - a, p - a), -1e-12);
    }
  }
}

TEST(ConvexHull, LeavesOutDuplicatesAndPointsOnItsSides) {
  std::vector<dvec2> points;
  for (int again = 0; again < 3; ++again)
    for (int y = 0; y <= 4; ++y)
      for (int x = 0; x <= 4; ++x) points.emplace_back(x, y);
  EXPECT_EQ(convexHull(points), (std::vector<dvec2>{{0, 0}, {4, 0}, {4, 4}, {0, 4}}));
}

TEST(ConvexHull, OfPointsWithoutArea) {
  EXPECT_TRUE(convexHull({}).empty());
  EXPECT_EQ(convexHull(std::vector<dvec2>(5, {2, 3})), (std::vector<dvec2>{{2, 3}}));
  std::vector<dvec2> line;
  for (const int i : {3, 0, 7, 7, 2}) line.emplace_back(i, 2 * i);
  EXPECT_EQ(convexHull(line), (std::vector<dvec2>{{0, 0}, {7, 14}}));
}

double sidesOf(const Rectangle& r, const dvec2& texels = dvec2(1)) {
  const dvec2 texel = (r.high - r.low) / texels;
  return texel.x + texel.y;
}

Rectangle around(const std::vector<dvec2>& points, double angle) {
  Rectangle r{{std::cos(angle), std::sin(angle)}};
  for (const dvec2& p : points) {
    const dvec2 at(glm::dot(p, r.axis), glm::dot(p, dvec2(-r.axis.y, r.axis.x)));
    r.low = glm::min(r.low, at);
    r.high = glm::max(r.high, at);
  }
  return r;
}

// The least sum of a texel's sides over many angles.
double bruteForce(const std::vector<dvec2>& points, const dvec2& texels = dvec2(1)) {
  double best = 1e300;
  for (int i = 0; i < 40000; ++i)
    best = std::min(best, sidesOf(around(points, std::numbers::pi * i / 40000), texels));
  return best;
}

TEST(SmallestRectangle, IsTheBestOfAllAngles) {
  for (const dvec2 texels : {dvec2(1), dvec2(1, 3), dvec2(200, 100)})
    for (std::size_t count = 3; count < 40; ++count) {
      const auto points = randomPoints(count, 1000 + count);
      const Rectangle r = smallestRectangle(convexHull(points), texels);
      const double brute = bruteForce(points, texels);
      EXPECT_LE(sidesOf(r, texels), brute * (1 + 2e-6)) << count;
      EXPECT_GE(sidesOf(r, texels), brute * 0.998) << count;
      EXPECT_LE(r.area(), around(points, 0).area());
      EXPECT_NEAR(glm::length(r.axis), 1, 1e-12);
      for (const dvec2& p : points) {
        const dvec2 q(glm::dot(p, r.axis), glm::dot(p, dvec2(-r.axis.y, r.axis.x)));
        EXPECT_TRUE(glm::all(glm::greaterThan(q, r.low - 1e-9)) && glm::all(glm::lessThan(q, r.high + 1e-9)));
      }
    }
}

TEST(SmallestRectangle, TurnsOnlyForABetterOne) {
  // Every side of a regular polygon has as good a rectangle, up to rounding.
  std::vector<dvec2> points;
  for (int i = 0; i < 128; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / 128;
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  EXPECT_EQ(smallestRectangle(convexHull(points)).axis, dvec2(1, 0));
}

TEST(SmallestRectangle, CornersThatAllButCoincideDontMislead) {
  builtin::Random random(7);
  for (std::size_t count = 3; count < 60; ++count) {
    std::vector<dvec2> points = randomPoints(count, 2000 + count);
    for (std::size_t i = 0; i < count; ++i)
      for (int again = 0; again < 4; ++again)
        points.push_back(points[i] + 1e-13 * dvec2(random.range(-1, 1), random.range(-1, 1)));
    const Rectangle r = smallestRectangle(convexHull(points));
    EXPECT_NEAR(sidesOf(r), bruteForce(points), 0.002 * sidesOf(r)) << count;
  }
}

TEST(SmallestRectangle, OfASquareATurnedSquareAndNoArea) {
  EXPECT_NEAR(smallestRectangle(std::vector<dvec2>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}).area(), 4, 1e-12);
  EXPECT_NEAR(smallestRectangle(std::vector<dvec2>{{1, 0}, {2, 1}, {1, 2}, {0, 1}}).area(), 2, 1e-12);
  EXPECT_TRUE(smallestRectangle({}).empty());
  const Rectangle point = smallestRectangle(std::vector<dvec2>{{3, 4}});
  EXPECT_EQ(point.low, point.high);
  const Rectangle line = smallestRectangle(std::vector<dvec2>{{0, 0}, {3, 4}});
  EXPECT_NEAR(line.high.x - line.low.x, 5, 1e-12);
  EXPECT_NEAR(line.high.y, line.low.y, 1e-12);
}

// The greatest of the corners' coordinates along a direction.
double reachOf(const Polytope& solid, const dvec3& direction) {
  double most = -1e300;
  solid.eachCorner([&](const dvec3& p) { most = std::max(most, glm::dot(p, direction)); });
  return most;
}

TEST(Polytope, KeepsCornersThatLieOnNoFaceOfTheBox) {
  Polytope box({-1, -1, -1}, {1, 1, 1});
  for (const dvec3& corner : {dvec3(1, 1, 1), dvec3(-1, -1, -1)}) EXPECT_NEAR(reachOf(box, corner), 3, 1e-12);
  // Three planes that meet in its middle: what is left is the tip there.
  box.clip({1, 0, 0, 0});
  box.clip({0, 1, 0, 0});
  box.clip({0, 0, 1, 0});
  EXPECT_NEAR(reachOf(box, {-1, -1, -1}), 0, 1e-12);
  EXPECT_NEAR(reachOf(box, {1, 1, 1}), 3, 1e-12);
  box.clip({-1, -1, -1, 0.5});
  EXPECT_NEAR(reachOf(box, {1, 1, 1}), 0.5, 1e-12);
  EXPECT_NEAR(reachOf(box, {1, 0, 0}), 0.5, 1e-12);
  box.clip({-1, 0, 0, -1});
  EXPECT_EQ(reachOf(box, {1, 0, 0}), -1e300) << "nothing is left";
}

class FrameMinimal : public RendererTest {
 protected:
  static double texelArea(const Rendering& r) {
    return double{r.plan[0].gpu.texelSize.x} * r.plan[0].gpu.texelSize.y;
  }
};

// The boxes of its clusters reach beyond it, seen from the light, and would make its map larger than the
// whole scene's.
TEST_F(FrameMinimal, ALeaningPlateGetsNoMoreThanItself) {
  SceneBuilder builder("plate");
  builder.addMaterial({.gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  const auto plate = builder.addMesh("plate", {{.positions = {{0, 0, 0}, {8, 0, 0}, {8, 0, 11}, {0, 0, 11}},
                                                .indices = {0, 1, 2, 0, 2, 3}}});
  builder.addInstance("plate", plate, glm::rotate(glm::dmat4(1), -0.25 * std::numbers::pi, dvec3(1, 0, 0)));
  const auto scene = sharedScene(std::move(builder).finish());
  const View whole{.eye = {4, 12, -10}, .target = {4, 4, 4}, .verticalFovDegrees = 70};
  const Light light{.direction = glm::normalize(dvec3(0.1, -1, 1))};
  const Rendering r = render(scene, whole, light, {64, 64}, "msf,texels=128");
  EXPECT_LE(texelArea(r), 1.0001 * texelArea(render(scene, whole, light, {64, 64}, "sm,texels=128")));
}

// Two triangles that fill half of their box, all in view.
TEST_F(FrameMinimal, TurnsToAPlateThatStandsOnItsCorner) {
  SceneBuilder builder("diamond");
  builder.addMaterial({.gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  const auto plate = builder.addMesh("plate", {{.positions = {{5, 0, 0}, {0, 0, -5}, {-5, 0, 0}, {0, 0, 5}},
                                                .indices = {0, 1, 2, 0, 2, 3}}});
  builder.addInstance("plate", plate, glm::dmat4(1));
  const auto scene = sharedScene(std::move(builder).finish());
  const View whole{.eye = {0, 12, 8}, .target = {0, 0, 0}, .verticalFovDegrees = 70};
  for (const Light& light : {sun(80, 0), spot({0, 20, 0}, {0.1, 0, 0}, 60)}) {
    const Rendering r = render(scene, whole, light, {64, 64}, "msf,texels=128");
    EXPECT_LT(texelArea(r), 0.55 * texelArea(render(scene, whole, light, {64, 64}, "sm,texels=128")));
    EXPECT_EQ(r.result.measures->pixelMatch, 1);
  }
}

// A wall that is lit from behind: the camera sees nothing of it that asks the map, but its shadow.
TEST_F(FrameMinimal, LeavesOutSidesThatTurnAwayFromTheLight) {
  const View view{.eye = {0, 3, 12}, .target = {0, 2, 0}, .verticalFovDegrees = 70};
  const Light light{.direction = glm::normalize(dvec3(0.1, -1, 0.5))};
  const auto rendered = [&](bool withWall, std::string_view method) {
    SceneBuilder builder("wall");
    builder.addMaterial({.gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
    const auto floor = builder.addMesh(
        "floor",
        {{.positions = {{-5, 0, -3}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -3}}, .indices = {0, 1, 2, 0, 2, 3}}});
    const auto wall = builder.addMesh(
        "wall",
        {{.positions = {{-12, 0, 0}, {12, 0, 0}, {12, 4, 0}, {-12, 4, 0}}, .indices = {0, 1, 2, 0, 2, 3}}});
    builder.addInstance("floor", floor, glm::dmat4(1));
    if (withWall) builder.addInstance("wall", wall, glm::dmat4(1));
    return render(sharedScene(std::move(builder).finish()), view, light, {160, 120}, method);
  };
  const Rendering r = rendered(true, "msf,texels=512");
  EXPECT_LE(texelArea(r), 1.001 * texelArea(rendered(false, "msf,texels=512")));
  EXPECT_LT(texelArea(r), 0.7 * texelArea(rendered(true, "sm,texels=512")));
  EXPECT_GT(r.result.measures->pixelMatch, 0.995);
  EXPECT_EQ(r.result.measures->interiorError, 0);
}

// Lookups that look around their texel find at a map's sides what they find in a map of the whole scene.
TEST_F(FrameMinimal, FiltersFindNothingWrongAtTheSides) {
  const auto scene = builtin("trees?count=40");
  for (const std::string_view lookup :
       {"lookup=pcf,kernel=9", "storage=triangle,lookup=spsm", "storage=triangle,lookup=rgsm"})
    for (const char* light : {"sun", "low"}) {
      SCOPED_TRACE(fmt::format("{} {}", lookup, light));
      const auto measured = [&](const char* name) {
        const Rendering r = render(scene, viewOf(*scene, "main"), lightOf(*scene, light), {160, 120},
                                   fmt::format("{},texels=512,{}", name, lookup));
        return *r.result.measures;
      };
      const auto fitted = measured("msf"), whole = measured("sm");
      EXPECT_LE(fitted.meanAbsError, whole.meanAbsError + 0.003);
      EXPECT_LE(fitted.interiorError, whole.interiorError + 0.003);
    }
}

TEST_F(FrameMinimal, HoldsAllThatIsSeenInLessThanTheScene) {
  for (const char* name : {"atrium", "trees?count=40", "grid"})
    for (const char* lightName : {"sun", "low", "noon", "spot"}) {
      const auto scene = builtin(name);
      for (const NamedView& named : scene->views) {
        SCOPED_TRACE(fmt::format("{} {} {}", name, named.name, lightName));
        const Light light = lightOf(*scene, lightName);
        const Rendering r = render(scene, named.view, light, {160, 120}, "msf,texels=512");
        const Rendering whole = render(scene, named.view, light, {160, 120}, "sm,texels=512");
        std::size_t outside = 0;
        for (std::size_t i = 0; i < r.pixels(); ++i) outside += whole.answered(i) && !r.answered(i);
        EXPECT_EQ(outside, 0u);
        EXPECT_LE(texelArea(r), 1.0001 * texelArea(whole));
        EXPECT_GE(r.result.measures->pixelMatch, whole.result.measures->pixelMatch - 0.005);
        // A caster that was lost, or clamped to the near plane, is wrong far from edges.
        EXPECT_LE(r.result.measures->interiorError, whole.result.measures->interiorError + 0.002);
      }
    }
}

TEST_F(FrameMinimal, AViewIntoTheCourtLosesNothing) {
  const auto scene = builtin("atrium");
  for (double x = -2; x <= 2; x += 0.5) {
    const View view{.eye = {2, 3, -1.2}, .target = {x, 3, -4.1}, .verticalFovDegrees = 60};
    const Rendering r = render(scene, view, lightOf(*scene, "sun"), {160, 120}, "msf,texels=512");
    EXPECT_LT(r.result.measures->interiorError, 0.003) << x;
  }
}

TEST_F(FrameMinimal, ALightAlongTheViewAndNothingInView) {
  const auto scene = builtin("atrium");
  const View view = viewOf(*scene, "main");
  const dvec3 along = glm::normalize(view.target - view.eye);
  for (const double turn : {0.0, 1e-7, 1e-3})
    for (const double sign : {1.0, -1.0}) {
      const Light light{.direction = sign * along + dvec3(0, turn, 0)};
      const Rendering r = render(scene, view, light, {160, 120}, "msf,texels=1024");
      EXPECT_GT(r.result.measures->pixelMatch, 0.98) << turn << " " << sign;
    }
  View sky = view;
  sky.eye = {0, 500, 0};
  sky.target = {1, 600, 0};
  for (const char* light : {"sun", "spot"}) {
    const Rendering r = render(scene, sky, lightOf(*scene, light), {64, 64}, "msf");
    EXPECT_EQ(r.plan[0].gpu.empty, 1u);
    EXPECT_EQ(r.result.measures->pixelMatch, 1);
  }
}

TEST_F(FrameMinimal, TheSecondFrameIsTheFirst) {
  const auto scene = builtin("atrium");
  RenderJob job = jobOf(scene, viewOf(*scene, "main"), lightOf(*scene, "spot"), {160, 120},
                        {"msf,texels=256"}, kAllImages, true);
  const auto once = render(job);
  job.repetitions = 3;
  const auto often = render(job);
  EXPECT_EQ(often[0].images.at(Aov::visibility).bytes, once[0].images.at(Aov::visibility).bytes);
  EXPECT_EQ(often[0].plan[0].shadowFromWorld, once[0].plan[0].shadowFromWorld);
}

}  // namespace
}  // namespace sundial::test
