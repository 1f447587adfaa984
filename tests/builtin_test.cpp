// The built-in scenes are the same everywhere, as large as stated, and grid's closed form tells the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_inverse.hpp>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "scene/builtin/grid.h"
#include "scene/builtin/random.h"
#include "scene/load.h"
#include "scene_invariants.h"

namespace sundial {
namespace {

// FNV-1a over everything that a renderer reads.
std::uint64_t hashOf(const Scene& scene) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](const auto& values) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(values[0]); ++i)
      hash = (hash ^ bytes[i]) * 1099511628211u;
  };
  add(scene.vertices);
  add(scene.attributes);
  add(scene.indices);
  add(scene.sourceTriangle);
  add(scene.clusters);
  for (const Instance& instance : scene.instances) {
    double matrix[16];
    std::memcpy(matrix, &instance.worldFromMesh, sizeof(matrix));
    add(std::span<const double>(matrix));
  }
  for (const auto& texture : scene.textures) add(texture);
  return hash;
}

TEST(Builtin, EveryRowKeepsTheInvariants) {
  ASSERT_GE(builtinScenes().size(), 3u);
  for (const BuiltinInfo& info : builtinScenes()) {
    SCOPED_TRACE(info.name);
    const Result<Scene> scene = makeBuiltin(info.name);
    ASSERT_TRUE(scene) << scene.error().message;
    expectInvariants(*scene);

    ASSERT_GE(scene->views.size(), 3u);
    EXPECT_EQ(scene->views[0].name, "main");
    ASSERT_GE(scene->lights.size(), 3u);
    EXPECT_EQ(scene->lights[0].name, "sun");
    EXPECT_NEAR(-glm::degrees(std::asin(scene->lights[0].light.direction.y)), 50, 1);
    bool low = false, spot = false;
    for (const NamedLight& light : scene->lights) {
      EXPECT_NEAR(glm::length(light.light.direction), 1, 1e-9);
      low |= light.name == "low" && std::abs(glm::degrees(std::asin(-light.light.direction.y)) - 5) < 0.01;
      spot |= light.name == "spot" && light.light.kind == LightKind::spot;
    }
    EXPECT_TRUE(low && spot);
    ASSERT_GE(scene->paths.size(), 1u);
    for (const NamedPath& path : scene->paths) EXPECT_TRUE(path.keys.size() >= 2 && path.frames >= 2);
  }
}

TEST(Builtin, TriangleCountsAreNearThoseOfThePapers) {
  const auto count = [](std::string_view name) {
    return static_cast<double>(makeBuiltin(name)->instancedTriangles());
  };
  EXPECT_NEAR(count("atrium"), 262'000, 2'600);
  EXPECT_NEAR(count("observatory"), 53'000, 600);
  EXPECT_NEAR(count("conference"), 126'700, 1'300);
  EXPECT_NEAR(count("trees"), 995'000, 5'000);
  EXPECT_NEAR(count("village"), 226'000, 2'000);
  EXPECT_NEAR(count("city"), 2'300'000, 20'000);
  EXPECT_NEAR(count("city?seed=2"), 2'300'000, 100'000);
  EXPECT_NEAR(count("knot"), 155'000, 1'500);
  EXPECT_EQ(count("grid"), 202);
}

// What its mesh's bounds can't tell, its clusters' must.
TEST(Builtin, VillageIsOneMeshOfSmallClusters) {
  const Result<Scene> scene = makeBuiltin("village");
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->meshes.size(), 1u);
  EXPECT_EQ(scene->instances.size(), 1u);
  EXPECT_EQ(scene->materials.size(), 1u);
  EXPECT_GT(scene->bounds.diagonal(), 400);
  std::vector<float> sizes;
  for (const shared::Cluster& cluster : scene->clusters)
    sizes.push_back(glm::distance(cluster.boundsMin, cluster.boundsMax));
  std::ranges::sort(sizes);
  EXPECT_LT(sizes[sizes.size() / 2], 0.02 * scene->bounds.diagonal());
  EXPECT_LT(sizes.back(), 0.15 * scene->bounds.diagonal());
}

// Every edge of its shells has two triangles that pass it in opposite directions, the seams' too; and each
// cell has a hole.
TEST(Builtin, KnotIsTwoClosedSurfacesFullOfHoles) {
  const Result<Scene> scene = makeBuiltin("knot?along=24");
  ASSERT_TRUE(scene);
  const Mesh& mesh = scene->meshes[scene->instances[0].mesh];
  using Point = std::array<float, 3>;
  std::map<std::pair<Point, Point>, int> directed;
  std::set<Point> points;
  for (std::uint32_t t = mesh.firstTriangle; t < mesh.firstTriangle + mesh.triangleCount; ++t) {
    std::array<Point, 3> p;
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::vec3& at = scene->vertices[scene->indices[3 * std::size_t{t} + c]].position;
      p[c] = {at.x, at.y, at.z};
      points.insert(p[c]);
    }
    for (std::size_t c = 0; c < 3; ++c) ++directed[{p[c], p[(c + 1) % 3]}];
  }
  for (const auto& [edge, count] : directed) {
    ASSERT_EQ(count, 1);
    ASSERT_EQ(directed.count({edge.second, edge.first}), 1u);
  }
  const auto euler = static_cast<int>(points.size()) - static_cast<int>(directed.size() / 2) +
                     static_cast<int>(mesh.triangleCount);
  constexpr int kHoles = 24 * 8 + 16 * 5;
  // A sheet has two sides, each a torus; every hole is a tube between them.
  EXPECT_EQ(euler, -2 * kHoles);
  EXPECT_EQ(mesh.triangleCount, kHoles * 96u);
}

TEST(Builtin, CityIsInstanced) {
  const Result<Scene> scene = makeBuiltin("city");
  ASSERT_TRUE(scene);
  EXPECT_LT(scene->sourceTriangle.size(), 150'000u);
  EXPECT_LT(scene->bytes(), 20'000'000u);
  EXPECT_GT(scene->bounds.max.z - scene->bounds.min.z, 1000);
  EXPECT_LT(scene->instances.size(), 4'000u);
}

// The nearest triangle along a ray, in metres; infinity where there is none. By brute force.
double distanceAlong(const Scene& scene, const glm::dvec3& from, const glm::dvec3& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dmat4 meshFromWorld = glm::affineInverse(instance.worldFromMesh);
    const glm::dvec3 o(meshFromWorld * glm::dvec4(from, 1)), d(meshFromWorld * glm::dvec4(direction, 0));
    const glm::dvec3 t0 = (glm::dvec3(mesh.boundsMin) - 1e-3 - o) / d;
    const glm::dvec3 t1 = (glm::dvec3(mesh.boundsMax) + 1e-3 - o) / d;
    const glm::dvec3 enter = glm::min(t0, t1), leave = glm::max(t0, t1);
    const double in = std::max({enter.x, enter.y, enter.z, 0.0});
    if (in > std::min({leave.x, leave.y, leave.z, nearest})) continue;
    for (std::uint32_t k = mesh.firstTriangle; k < mesh.firstTriangle + mesh.triangleCount; ++k) {
      const auto p = [&](std::size_t c) {
        return glm::dvec3(scene.vertices[scene.indices[3 * std::size_t{k} + c]].position);
      };
      const glm::dvec3 a = p(0), ab = p(1) - a, ac = p(2) - a, h = glm::cross(d, ac), s = o - a;
      const double determinant = glm::dot(ab, h);
      const double u = glm::dot(s, h) / determinant;
      const glm::dvec3 q = glm::cross(s, ab);
      const double v = glm::dot(d, q) / determinant, t = glm::dot(ac, q) / determinant;
      if (u >= 0 && v >= 0 && u + v <= 1 && t > 0) nearest = std::min(nearest, t);
    }
  }
  return nearest;
}

// Distances from a view's eye over an n x n picture of it, sorted.
std::vector<double> distancesOf(const Scene& scene, const View& view, int n) {
  const glm::dvec3 forward = glm::normalize(view.target - view.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, view.up)), up = glm::cross(right, forward);
  const double half = std::tan(glm::radians(view.verticalFovDegrees) / 2);
  std::vector<double> distances;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = half * (2 * (i + 0.5) / n - 1), y = half * (2 * (j + 0.5) / n - 1);
      const glm::dvec3 ray = glm::normalize(forward + x * right + y * up);
      distances.push_back(distanceAlong(scene, view.eye, ray));
    }
  std::ranges::sort(distances);
  return distances;
}

const View& viewNamed(const Scene& scene, std::string_view name) {
  return std::ranges::find(scene.views, name, &NamedView::name)->view;
}

TEST(Builtin, ViewsOfVillageAndCitySeeGeometryFromTheOpen) {
  for (const std::string_view name : {"village", "village?seed=5", "city", "city?seed=5"}) {
    const Result<Scene> scene = makeBuiltin(name);
    ASSERT_TRUE(scene);
    for (const NamedView& view : scene->views) {
      const std::vector<double> distances = distancesOf(*scene, view.view, 4);
      EXPECT_GT(distances.front(), 0.4) << name << ' ' << view.name;
      EXPECT_LT(distances[distances.size() / 3], 1e6) << name << ' ' << view.name;
    }
  }
}

TEST(Builtin, CityHasDepthAndGapsInDepth) {
  const Result<Scene> scene = makeBuiltin("city");
  ASSERT_TRUE(scene);
  const View& avenue = viewNamed(*scene, "avenue");
  EXPECT_LT(distancesOf(*scene, avenue, 12).front(), 8);
  // Only its vanishing point is far away.
  View down = avenue;
  down.verticalFovDegrees = 4;
  const std::vector<double> distances = distancesOf(*scene, down, 12);
  EXPECT_GT(*std::prev(std::ranges::upper_bound(distances, 1e6)), 700);

  // Over the roof's edge: something near, nothing for tens of metres, and much beyond.
  const std::vector<double> gap = distancesOf(*scene, viewNamed(*scene, "gap"), 24);
  const auto beyond = std::ranges::upper_bound(gap, 8.0);
  EXPECT_GT(beyond - gap.begin(), 30);
  EXPECT_GT(gap.end() - beyond, 200);
  EXPECT_GT(*beyond, 16);

  const NamedPath& path = *std::ranges::find(scene->paths, "near-leaf", &NamedPath::name);
  EXPECT_GT(distancesOf(*scene, path.keys.front(), 24).front(), 2);
  EXPECT_LT(distancesOf(*scene, path.keys.back(), 24).front(), 1);
}

TEST(Builtin, IsTheSameEachTime) {
  for (const BuiltinInfo& info : builtinScenes())
    EXPECT_EQ(hashOf(*makeBuiltin(info.name)), hashOf(*makeBuiltin(info.name))) << info.name;
}

TEST(Builtin, IsTheSameOnEveryMachine) {
  EXPECT_EQ(hashOf(*makeBuiltin("atrium")), 2000448353945094322u);
  EXPECT_EQ(hashOf(*makeBuiltin("observatory")), 10210785139502989333u);
  EXPECT_EQ(hashOf(*makeBuiltin("conference")), 15616968351507818110u);
  EXPECT_EQ(hashOf(*makeBuiltin("trees")), 5303061929892748117u);
  EXPECT_EQ(hashOf(*makeBuiltin("village")), 16964394244318166693u);
  EXPECT_EQ(hashOf(*makeBuiltin("city")), 11431884775052123394u);
  EXPECT_EQ(hashOf(*makeBuiltin("knot")), 5501866744265861404u);
  EXPECT_EQ(hashOf(*makeBuiltin("grid")), 13861217816283974019u);
}

TEST(Builtin, ParametersAreObeyedAndChecked) {
  EXPECT_EQ(makeBuiltin("trees?count=30")->instances.size(), 31u);
  EXPECT_NE(hashOf(*makeBuiltin("trees?count=30&seed=1")), hashOf(*makeBuiltin("trees?seed=2&count=30")));
  EXPECT_EQ(makeBuiltin("grid?n=3")->sourceTriangle.size(), 20u);
  const auto expectError = [](std::string_view reference, ErrorCode code, const std::string& words) {
    const Result<Scene> scene = makeBuiltin(reference);
    ASSERT_FALSE(scene) << reference;
    EXPECT_EQ(scene.error().code, code);
    EXPECT_NE(scene.error().message.find(words), std::string::npos) << scene.error().message;
  };
  expectError("sponza", ErrorCode::notFound,
              "there are: atrium, observatory, conference, trees, village, city, knot, grid");
  expectError("", ErrorCode::notFound, "atrium");
  expectError("trees?count=0", ErrorCode::invalidArgument, "must be an integer, 1 to 20000");
  expectError("trees?count=", ErrorCode::invalidArgument, "1 to 20000");
  expectError("trees?count=5x", ErrorCode::invalidArgument, "1 to 20000");
  expectError("trees?count=-5", ErrorCode::invalidArgument, "1 to 20000");
  expectError("trees?count=99999999999999999999", ErrorCode::invalidArgument, "1 to 20000");
  expectError("trees?size=3", ErrorCode::invalidArgument, "count 1 to 20000, seed 0 to 4294967295");
  expectError("atrium?x=1", ErrorCode::invalidArgument, "it has: none");
}

TEST(Builtin, SinesAreSines) {
  for (int i = -5000; i <= 5000; ++i) {
    const double turns = i / 777.0;
    EXPECT_NEAR(builtin::sinTurns(turns), std::sin(turns * 2 * std::acos(-1.0)),
                3e-15 * (1 + std::abs(turns) * 6));
    EXPECT_NEAR(builtin::cosTurns(turns), std::cos(turns * 2 * std::acos(-1.0)),
                3e-15 * (1 + std::abs(turns) * 6));
  }
}

// Whether some triangle of the scene's plates lies between a ground point and the light: by brute force, from
// the triangles alone.
bool reachesLight(const Scene& scene, const glm::dvec3& point, const Light& light) {
  const glm::dvec3 towards = light.kind == LightKind::directional ? -light.direction : light.position - point;
  for (std::size_t t = 0; t < scene.sourceTriangle.size(); ++t) {
    const auto p = [&](std::size_t c) {
      return glm::dvec3(scene.vertices[scene.indices[3 * t + c]].position);
    };
    const double s = (p(0).y - point.y) / towards.y;
    if (p(0).y <= point.y || s > 1e9 || (light.kind != LightKind::directional && s >= 1)) continue;
    const glm::dvec3 hit = point + s * towards;
    int sides = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::dvec3 a = p(c), b = p((c + 1) % 3);
      sides += (b.x - a.x) * (hit.z - a.z) - (b.z - a.z) * (hit.x - a.x) > 0 ? 1 : -1;
    }
    if (std::abs(sides) == 3) return false;
  }
  return true;
}

TEST(Grid, ClosedFormAgreesWithTheTriangles) {
  const Result<Scene> scene = makeBuiltin("grid");
  ASSERT_TRUE(scene);
  const std::vector<builtin::Plate> plates = builtin::gridPlates(10);
  ASSERT_EQ(plates.size(), 100u);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-builtin::gridGroundHalf(10), builtin::gridGroundHalf(10));
  for (const NamedLight& light : scene->lights) {
    for (const double height : {0.0, 1.25}) {  // on the ground and on plates
      const builtin::GridShadow shadow(plates, light.light, height);
      int lit = 0, dark = 0;
      for (int i = 0; i < 4000; ++i) {
        const glm::dvec2 p(anywhere(random), anywhere(random));
        if (shadow.edgeDistance(p) < 1e-9) continue;
        const bool truth = reachesLight(*scene, {p.x, height, p.y}, light.light);
        ASSERT_EQ(shadow.lit(p), truth) << light.name << " at " << p.x << ", " << p.y;
        ++(truth ? lit : dark);
      }
      EXPECT_GT(lit, 0) << light.name;
      // A sun 1 degree above the horizon throws all shadows of so few plates beyond the ground.
      if (light.name != "horizon") {
        EXPECT_GT(dark, 0) << light.name;
      }
    }
  }
}

TEST(Grid, EdgeDistanceIsWhereLightChanges) {
  const std::vector<builtin::Plate> plates = builtin::gridPlates(10);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> anywhere(-10, 10), turn(0, 1);
  const Result<Scene> scene = makeBuiltin("grid");
  ASSERT_TRUE(scene);
  for (const NamedLight& light : scene->lights) {
    const builtin::GridShadow shadow(plates, light.light);
    for (int i = 0; i < 300; ++i) {
      const glm::dvec2 p(anywhere(random), anywhere(random));
      const double distance = shadow.edgeDistance(p);
      // Nothing changes within the distance; something does just beyond it, in one of many directions.
      bool changes = false;
      for (int k = 0; k < 720; ++k) {
        const double angle = k / 720.0;
        const glm::dvec2 direction(builtin::cosTurns(angle), builtin::sinTurns(angle));
        ASSERT_EQ(shadow.lit(p + direction * (distance * turn(random) * 0.999)), shadow.lit(p)) << light.name;
        changes |= shadow.lit(p + direction * (distance * 1.02 + 1e-6)) != shadow.lit(p);
      }
      EXPECT_TRUE(changes) << light.name << " at " << p.x << ", " << p.y;
    }
  }
}

}  // namespace
}  // namespace sundial
