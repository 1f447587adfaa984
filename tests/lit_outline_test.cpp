// What a minimal shadow frustum leaves out is never looked up: triangles that can't be lit, and what lies
// beyond the outline of those that can.
#include "shadow/lit_outline.h"

#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "bench/frame_scene.h"
#include "shadow/camera.h"
#include "shadow/convex_hull.h"
#include "shadow/polygon.h"
#include "support/device_test.h"
#include "support/rendering.h"

namespace sundial::test {
namespace {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

// How far a point lies beyond the hull's sides.
double beyond(std::span<const dvec2> hull, const dvec2& p) {
  double most = -1e300;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const dvec2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    most = std::max(most, -cross(b - a, p - a) / glm::distance(a, b));
  }
  return most;
}

double areaOf(std::span<const dvec2> hull) {
  double twice = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) twice += cross(hull[i], hull[(i + 1) % hull.size()]);
  return twice / 2;
}

double extentOf(std::span<const dvec2> hull) {
  const Rectangle around = smallestRectangle(hull);
  return std::max(around.high.x - around.low.x, around.high.y - around.low.y);
}

dvec3 divided(const dvec4& p) { return dvec3(p) / p.w; }

// What the camera sees that faces the light, and what it is told from.
struct Sighted {
  shared::FrameConstants constants;
  PlacedClusters clusters;
  std::vector<shared::ViewSample> lit;  // that face the light
};

class LitOutline : public DeviceTest<> {
 protected:
  static Sighted look(const std::shared_ptr<const Scene>& scene, const View& view, const Light& light) {
    static FramePipelines pipelines(device());
    const glm::uvec2 image(320, 240);
    const bench::FrameScene sight(device(), pipelines, {scene, view, light}, image);
    sight.frame(light.kind == LightKind::point ? "sm,partition=cube,texels=16" : "sm,texels=16");
    const dvec3 origin = frameOrigin(*scene, view);
    const SceneBuffers buffers(device(), scene);
    Sighted out{frameConstants(*scene, view, light, image, origin), PlacedClusters(buffers, origin), {}};
    const auto samples = sight.samples();
    const auto faces = sight.facing();
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (faces[i] != 0) out.lit.push_back(samples[i]);
    return out;
  }
};

struct Case {
  std::string_view scene, view, light;
};
constexpr Case kCases[] = {{"atrium", "main", "sun"},         {"atrium", "main", "spot"},
                           {"observatory", "main", "spot"},   {"observatory", "main", "sun"},
                           {"conference", "main", "sun"},     {"trees?count=40", "walk", "low"},
                           {"trees?count=40", "main", "sun"}, {"knot", "main", "sun"},
                           {"grid", "main", "sun"},           {"grid", "shadows", "low"}};

// The triangles of the clusters, by instance and index in the scene.
using Triangles = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Triangles thatMayBeLit(const Scene& scene, const Sighted& sighted) {
  const Onlookers onlookers(sighted.constants);
  Triangles out;
  for (std::size_t i = 0; i < sighted.clusters.boxes().size(); ++i) {
    const PlacedCluster cluster = sighted.clusters[i];
    const auto first = static_cast<std::uint32_t>(cluster.indices.data() - scene.indices.data()) / 3;
    for (std::uint32_t t = 0; t < cluster.triangles(); ++t)
      if (onlookers.mayBeLit(cluster.triangle(t), cluster.doubleSided, stretchOf(cluster.worldFromMesh)))
        out.emplace(sighted.clusters.draws()[i].instance, first + t);
  }
  return out;
}

// Half of the instances mirrored, one of them squeezed and sheared, both kinds of materials.
std::shared_ptr<const Scene> mirroredScene() {
  SceneBuilder builder("mirrored");
  const auto front = builder.addMaterial({.gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}});
  const auto both =
      builder.addMaterial({.gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  const std::vector<glm::vec3> corners = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const std::vector<std::uint32_t> faces = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
  const auto solid = builder.addMesh("solid", {{.positions = corners, .indices = faces, .material = front}});
  const auto shell = builder.addMesh("shell", {{.positions = corners, .indices = faces, .material = both}});
  for (int i = 0; i < 8; ++i) {
    dmat4 place = glm::translate(dmat4(1), dvec3(4 * (i % 4), i % 3, 4 * (i / 4)));
    place = glm::rotate(place, 0.7 * i, dvec3(1, 2, 0.5));
    if (i % 2) place = glm::scale(place, dvec3(-1, 1, 1));
    if (i == 5) place[0] = 0.01 * place[0] + 0.9 * place[1];
    builder.addInstance("solid", i % 3 ? solid : shell, place);
  }
  return sharedScene(std::move(builder).finish());
}

// The triangles that are left out.
std::size_t expectOnlyOfThoseThatMayBeLit(const Scene& scene, const Sighted& sighted) {
  const Triangles may = thatMayBeLit(scene, sighted);
  for (const shared::ViewSample& s : sighted.lit)
    EXPECT_TRUE(may.contains({s.instance, s.triangle})) << s.instance << " " << s.triangle;
  return scene.instancedTriangles() - may.size();
}

TEST_F(LitOutline, NoSampleThatFacesTheLightIsOfATriangleThatCantBeLit) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(fmt::format("{} {} {}", c.scene, c.view, c.light));
    const auto scene = builtin(c.scene);
    const auto leftOut =
        expectOnlyOfThoseThatMayBeLit(*scene, look(scene, viewOf(*scene, c.view), lightOf(*scene, c.light)));
    EXPECT_GE(leftOut, c.scene == "grid" ? 0 : scene->instancedTriangles() / 10);
  }
  const auto scene = mirroredScene();
  const View view{.eye = {-3, 5, 12}, .target = {6, 1, 2}, .verticalFovDegrees = 70};
  for (const Light& light : {sun(50, 20), sun(20, 200), spot({6, 9, 2}, {6, 0, 2}, 100), point({5, 0.5, 2})})
    EXPECT_GT(expectOnlyOfThoseThatMayBeLit(*scene, look(scene, view, light)), 4u);
}

// All samples in it, a hair at most beside it: a map's rim is a texel wide.
void expectWithin(const Outline& outline, const glm::mat4& lightFromWorld,
                  std::span<const shared::ViewSample> samples) {
  const double hair = 1e-5 * extentOf(outline.corners);
  for (const shared::ViewSample& s : samples) {
    const dvec3 at = divided(dmat4(lightFromWorld) * dvec4(dvec3(s.wsPosition), 1));
    ASSERT_LT(beyond(outline.corners, dvec2(at)), hair);
    ASSERT_GE(at.z, outline.farZ - 1e-4 * std::abs(outline.farZ) - 1e-4);
  }
}

// By all triangles, and without the haste.
Outline byAllTriangles(const LitPart& part, const PlacedClusters& clusters) {
  std::vector<dvec2> points;
  for (std::size_t c = 0; c < clusters.boxes().size(); ++c)
    for (std::size_t t = 0; t < clusters[c].triangles(); ++t) {
      const PlacedTriangle triangle = clusters[c].triangle(t);
      if (!part.onlookers.mayBeLit(triangle, clusters[c].doubleSided, stretchOf(clusters[c].worldFromMesh)))
        continue;
      std::vector<dvec3> seen(triangle.begin(), triangle.end());
      for (const dvec4& plane : part.planes)
        clip(seen, [&](const dvec3& p) { return glm::dot(plane, dvec4(p, 1)); });
      std::vector<dvec2> polygon;
      for (const dvec3& p : seen) polygon.emplace_back(divided(dmat4(part.lightFromWorld) * dvec4(p, 1)));
      constexpr int kSides = 1280;
      for (int i = 0; std::isfinite(part.coneRadius) && i < kSides; ++i) {
        const double angle = glm::radians(360.0) * i / kSides;
        clip(polygon, [&](const dvec2& p) {
          return part.coneRadius - glm::dot(p, dvec2(std::cos(angle), std::sin(angle)));
        });
      }
      points.insert(points.end(), polygon.begin(), polygon.end());
    }
  return {convexHull(points)};
}

// By all boxes.
double areaOfBoxes(const LitPart& part, const PlacedClusters& clusters) {
  std::vector<dvec2> points;
  for (const WorldBox& box : clusters.boxes())
    eachCornerWithin(box, part.planes, [&](const dvec3& p) {
      points.emplace_back(divided(dmat4(part.lightFromWorld) * dvec4(p, 1)));
    });
  return areaOf(convexHull(points));
}

TEST_F(LitOutline, IsTheHullOfAllTrianglesAndHoldsEverySample) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(fmt::format("{} {} {}", c.scene, c.view, c.light));
    const auto scene = builtin(c.scene);
    const Sighted sighted = look(scene, viewOf(*scene, c.view), lightOf(*scene, c.light));
    const LitPart part = litPart(sighted.constants);
    const Outline outline = litOutline(part, sighted.clusters);
    expectWithin(outline, part.lightFromWorld, sighted.lit);

    const Outline all = byAllTriangles(part, sighted.clusters);
    for (const dvec2& p : all.corners)
      EXPECT_LT(beyond(outline.corners, p), 1e-6 * extentOf(outline.corners));
    EXPECT_LE(areaOf(outline.corners), 1.001 * areaOf(all.corners));
    EXPECT_LE(areaOf(outline.corners), (1 + 1e-9) * areaOfBoxes(part, sighted.clusters));
  }
}

TEST_F(LitOutline, OfEachFaceAroundAPointLight) {
  const auto scene = builtin("observatory");
  for (const std::string_view view : {"main", "floor", "dome"}) {
    const Sighted sighted = look(scene, viewOf(*scene, view), lightOf(*scene, "lamp"));
    for (std::uint32_t face = 0; face < shared::kCubeFaces; ++face) {
      SCOPED_TRACE(fmt::format("{} {}", view, face));
      std::vector<shared::ViewSample> inFace;
      for (const shared::ViewSample& s : sighted.lit)
        if (shared::faceOf(sighted.constants.lightFromWorld * glm::vec4(s.wsPosition, 1)) == face)
          inFace.push_back(s);
      const LitPart part = litPartOfFace(sighted.constants, face);
      const Outline outline = litOutline(part, sighted.clusters);
      if (!inFace.empty()) expectWithin(outline, part.lightFromWorld, inFace);
      EXPECT_LE(areaOf(outline.corners), (1 + 1e-9) * areaOfBoxes(part, sighted.clusters));
    }
  }
}

// Rings that face away from the light, one around the other, about a plate that faces it: more of them than
// the search looks into, so that boxes remain.
TEST_F(LitOutline, HoldsWhatIsSeenWhereTheSearchEnds) {
  SceneBuilder builder("rings");
  const auto material =
      builder.addMaterial({.gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  const auto plate = [&](const char* name, std::vector<glm::vec3> corners) {
    return builder.addMesh(
        name, {{.positions = std::move(corners), .indices = {0, 1, 2, 0, 2, 3}, .material = material}});
  };
  const auto floor = plate("floor", {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}});
  const auto wall = plate("wall", {{-1, 0, 0}, {1, 0, 0}, {1, 0.5, 0}, {-1, 0.5, 0}});
  builder.addInstance("floor", floor, dmat4(1));
  // The camera sees their near sides, the light their far ones.
  for (int i = 0; i < 200; ++i)
    builder.addInstance(
        "wall", wall, glm::scale(glm::translate(dmat4(1), dvec3(0, 0, -1.5 - 0.05 * i)), dvec3(1 + 0.1 * i)));
  const auto scene = sharedScene(std::move(builder).finish());
  const View view{.eye = {0, 14, 16}, .target = {0, 2, 0}, .verticalFovDegrees = 80};
  const Light light{.direction = glm::normalize(dvec3(0, -1, 0.5))};
  const Sighted sighted = look(scene, view, light);
  ASSERT_FALSE(sighted.lit.empty());
  const LitPart part = litPart(sighted.constants);
  const Outline outline = litOutline(part, sighted.clusters);
  expectWithin(outline, part.lightFromWorld, sighted.lit);
  EXPECT_LT(areaOf(outline.corners), areaOfBoxes(part, sighted.clusters));
  EXPECT_GT(areaOf(outline.corners), 2 * areaOf(byAllTriangles(part, sighted.clusters).corners))
      << "it ended";
}

Onlookers onlookers(const dvec3& eye, const Light& light) {
  const Scene scene = *builtin("grid");
  const View view{.eye = eye, .target = eye + dvec3(1, -1, 0.1)};
  Light unit = light;
  unit.direction = glm::normalize(unit.direction);
  return Onlookers(frameConstants(scene, view, unit, {640, 480}, dvec3(0)));
}

TEST(Onlookers, AskForCameraAndLightOnOneSide) {
  const PlacedTriangle floor = {dvec3(0, 0, 0), dvec3(0, 0, 1), dvec3(1, 0, 0)};  // its front is above
  const Light down{.direction = {0.2, -1, 0}}, up{.direction = {0.2, 1, 0}};
  const dvec3 above(0, 3, 0), below(0, -3, 0);
  for (const bool doubleSided : {true, false}) {
    EXPECT_TRUE(onlookers(above, down).mayBeLit(floor, doubleSided, 1));
    EXPECT_FALSE(onlookers(above, up).mayBeLit(floor, doubleSided, 1));
    EXPECT_FALSE(onlookers(below, down).mayBeLit(floor, doubleSided, 1));
    EXPECT_EQ(onlookers(below, up).mayBeLit(floor, doubleSided, 1), doubleSided);
    // A lamp behind its edge is above its plane all the same.
    EXPECT_TRUE(onlookers(above, point({9, 0.5, 0})).mayBeLit(floor, doubleSided, 1));
    EXPECT_FALSE(onlookers(above, point({9, -0.5, 0})).mayBeLit(floor, doubleSided, 1));
  }
}

TEST(Onlookers, LeaveOutNothingThatRoundingCouldLight) {
  const PlacedTriangle floor = {dvec3(0, 0, 0), dvec3(0, 0, 1), dvec3(1, 0, 0)};
  const Light up{.direction = {0.2, 1, 0}}, down{.direction = {0.2, -1, 0}};
  const dvec3 above(0, 3, 0), below(0, -3, 0);
  // In the plane, all but.
  EXPECT_TRUE(onlookers({0, 1e-5, 0}, up).mayBeLit(floor, true, 1));
  EXPECT_TRUE(onlookers(above, {.direction = {1, 1e-5, 0}}).mayBeLit(floor, true, 1));
  EXPECT_TRUE(onlookers(above, point({3, -1e-5, 0})).mayBeLit(floor, true, 1));
  // A triangle without an area, one with hardly any, and one whose placement spoils its edges.
  EXPECT_TRUE(onlookers(above, up).mayBeLit({dvec3(0), dvec3(1, 0, 0), dvec3(2, 0, 0)}, true, 1));
  EXPECT_TRUE(onlookers(above, up).mayBeLit({dvec3(0), dvec3(1, 0, 1e-7), dvec3(2, 0, 0)}, true, 1));
  EXPECT_TRUE(onlookers(above, up).mayBeLit(floor, true, 1e7));
  // Seen from behind, but so small in the picture that snapping may turn it.
  const PlacedTriangle tiny = {1e-5 * floor[0], 1e-5 * floor[1], 1e-5 * floor[2]};
  EXPECT_FALSE(onlookers(below, up).mayBeLit(floor, false, 1));
  EXPECT_TRUE(onlookers(below, up).mayBeLit(tiny, false, 1));
  EXPECT_FALSE(onlookers(below, down).mayBeLit(tiny, false, 1)) << "whichever way it turns, it isn't lit";
}

}  // namespace
}  // namespace sundial::test
