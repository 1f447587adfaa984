// What every scene goes through, whatever it was made from.
#include "scene/scene_builder.h"

#include <gtest/gtest.h>

#include <meshoptimizer.h>
#include <glm/gtc/matrix_transform.hpp>

#include <limits>
#include <random>

#include "scene/clusters.h"
#include "scene/provoking.h"
#include "scene/texture_resize.h"
#include "scene_invariants.h"

namespace sundial {
namespace {

MaterialInfo plain() {
  MaterialInfo material;
  material.name = "plain";
  material.gpu = {.baseColour = glm::vec4(1),
                  .alphaCutoff = 0,
                  .texture = shared::kNoTexture,
                  .wrapU = shared::kWrapRepeat,
                  .wrapV = shared::kWrapRepeat};
  return material;
}

// A closed grid on a torus: every vertex has six triangles, twice as many triangles as vertices.
Primitive torus(std::uint32_t n) {
  Primitive primitive;
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const double u = 6.283185307 * i / n, v = 6.283185307 * j / n;
      primitive.positions.emplace_back((3 + std::cos(v)) * std::cos(u), std::sin(v),
                                       (3 + std::cos(v)) * std::sin(u));
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t i1 = (i + 1) % n, j1 = (j + 1) % n;
      const std::uint32_t a = j * n + i, b = j * n + i1, c = j1 * n + i1, d = j1 * n + i;
      primitive.indices.insert(primitive.indices.end(), {a, b, c, a, c, d});
    }
  return primitive;
}

Result<Scene> built(std::vector<Primitive> primitives, const glm::dmat4& transform = glm::dmat4(1)) {
  SceneBuilder builder("test");
  builder.addMaterial(plain());
  builder.addInstance("instance", builder.addMesh("some mesh", std::move(primitives)), transform);
  return std::move(builder).finish();
}

Primitive triangle() {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  primitive.indices = {0, 1, 2};
  return primitive;
}

TEST(SceneBuilder, KeepsTheInvariantsOfAClosedMesh) {
  const Result<Scene> scene = built({torus(150)});
  ASSERT_TRUE(scene);
  expectInvariants(*scene);
  EXPECT_EQ(scene->sourceTriangle.size(), 45'000u);
  EXPECT_LE(scene->vertices.size(), 45'000u * 105 / 100);
}

TEST(SceneBuilder, KeepsWindingAndPlace) {
  const Primitive source = torus(40);
  const Result<Scene> scene = built({source});
  ASSERT_TRUE(scene);
  for (const SourceTriangle& t : sourceTriangles(*scene)) {
    SourceTriangle expected{0, t.source, {}};
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::vec3& p = source.positions[source.indices[3 * t.source + c]];
      expected.corners[c] = {p.x, p.y, p.z};
    }
    std::ranges::rotate(expected.corners, std::ranges::min_element(expected.corners));
    ASSERT_EQ(t, expected);
  }
}

TEST(SceneBuilder, CountsSourceTrianglesOverPrimitives) {
  Primitive first = triangle();
  first.indices = {0, 1, 1, 0, 1, 2, 0, 2, 0};
  const Result<Scene> scene = built({first, triangle()});
  ASSERT_TRUE(scene);
  expectInvariants(*scene);
  EXPECT_EQ(scene->degenerateTriangles, 2u);
  EXPECT_EQ(scene->sourceTriangle, (std::vector<std::uint32_t>{1, 3}));
}

TEST(SceneBuilder, DropsTrianglesWithoutArea) {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {0, 0, 0}, {0, 1, 0}};
  primitive.indices = {0, 1, 2, 0, 3, 1, 0, 1, 4};  // in a line, two in one place, good
  const Result<Scene> scene = built({primitive});
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->degenerateTriangles, 2u);
  EXPECT_EQ(scene->sourceTriangle, (std::vector<std::uint32_t>{2}));
}

TEST(SceneBuilder, WeldsVerticesThatAgreeInEverything) {
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  primitive.indices = {0, 1, 2, 3, 4, 5};
  EXPECT_EQ(built({primitive})->vertices.size(), 4u);
  primitive.uvs = {{0, 0}, {1, 0}, {1, 1}, {0.5, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(built({primitive})->vertices.size(), 5u);
  primitive.colours = {1, 1, 1, 1, 2, 1};
  EXPECT_EQ(built({primitive})->vertices.size(), 6u);
}

TEST(SceneBuilder, ManyCoincidentTrianglesStillMakeClusters) {
  Primitive primitive = triangle();
  for (int i = 0; i < 999; ++i) primitive.indices.insert(primitive.indices.end(), {0, 1, 2});
  const Result<Scene> scene = built({primitive});
  ASSERT_TRUE(scene);
  expectInvariants(*scene);
  EXPECT_EQ(scene->clusters.size(), 8u);
}

TEST(SceneBuilder, AcceptsTheLargestAndSmallestFloats) {
  constexpr float kMax = std::numeric_limits<float>::max(), kMin = std::numeric_limits<float>::denorm_min();
  Primitive primitive;
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    const auto pick = [&] {
      constexpr std::array<float, 6> kValues{-kMax, kMax, 0, kMin, -kMin, 1};
      return kValues[random() % kValues.size()];
    };
    primitive.positions.emplace_back(pick(), pick(), pick());
    primitive.indices.push_back(static_cast<std::uint32_t>(i));
  }
  const Result<Scene> scene = built({primitive});
  ASSERT_TRUE(scene);
  expectInvariants(*scene);
}

TEST(SceneBuilder, NamesWhatIsWrong) {
  const auto expectError = [](const Result<Scene>& scene, const std::string& words) {
    ASSERT_FALSE(scene) << words;
    EXPECT_EQ(scene.error().code, ErrorCode::invalidArgument);
    EXPECT_NE(scene.error().message.find(words), std::string::npos) << scene.error().message;
  };
  Primitive bad = triangle();
  bad.indices[1] = 3;
  expectError(built({triangle(), bad}),
              "mesh 'some mesh', primitive 1: index 1 is 3, but there are 3 vertices");
  bad = triangle();
  bad.positions[2].y = std::numeric_limits<float>::quiet_NaN();
  expectError(built({bad}), "vertex 2 has a position that is not finite");
  bad = triangle();
  bad.uvs = {{0, 0}};
  expectError(built({bad}), "1 texture coordinates for 3 positions");
  bad = triangle();
  bad.material = 4;
  expectError(built({bad}), "material 4 is out of range, there are 1");
  bad = triangle();
  bad.indices.pop_back();
  expectError(built({bad}), "2 indices are not whole triangles");

  glm::dmat4 singular(1);
  singular[1] = singular[0];
  expectError(built({triangle()}, singular),
              "instance 'instance' of mesh 'some mesh': its transform is singular");
  expectError(built({triangle()}, glm::dmat4(0)), "not affine");
  glm::dmat4 infinite(1);
  infinite[3][0] = std::numeric_limits<double>::infinity();
  expectError(built({triangle()}, infinite), "not finite");
  glm::dmat4 tiny(1e-9);
  tiny[3][3] = 1;
  EXPECT_TRUE(built({triangle()}, tiny));
}

TEST(SceneBuilder, DropsInstancesOfNothing) {
  const Result<Scene> scene = built({});
  ASSERT_TRUE(scene);
  EXPECT_TRUE(scene->instances.empty());
  EXPECT_EQ(scene->bounds.diagonal(), 0);
  const View view = defaultView(*scene);
  EXPECT_GT(glm::distance(view.eye, view.target), 0);
}

double halfArea(const glm::vec3& lo, const glm::vec3& hi) {
  const glm::dvec3 d(hi - lo);
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

// The yardstick: meshoptimizer's own clusters.
TEST(Clusters, HaveSmallerBoxesThanMeshletsAndAreNearlyAsFew) {
  const Primitive source = torus(128);
  const TriangleClusters clusters = clusterTriangles(source.positions, source.indices);
  const std::size_t count = clusters.first.size() - 1;
  double area = 0;
  for (std::size_t i = 0; i < count; ++i) {
    glm::vec3 lo(1e9f), hi(-1e9f);
    for (std::uint32_t t = clusters.first[i]; t < clusters.first[i + 1]; ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        lo = glm::min(lo, source.positions[source.indices[3 * clusters.order[t] + c]]);
        hi = glm::max(hi, source.positions[source.indices[3 * clusters.order[t] + c]]);
      }
    area += halfArea(lo, hi);
  }

  constexpr std::size_t kMaxVertices = 255;
  const std::size_t bound =
      meshopt_buildMeshletsBound(source.indices.size(), kMaxVertices, shared::kMaxClusterTriangles);
  std::vector<meshopt_Meshlet> meshlets(bound);
  std::vector<unsigned> vertices(bound * kMaxVertices);
  std::vector<unsigned char> triangles(bound * shared::kMaxClusterTriangles * 3);
  meshlets.resize(meshopt_buildMeshlets(meshlets.data(), vertices.data(), triangles.data(),
                                        source.indices.data(), source.indices.size(), &source.positions[0].x,
                                        source.positions.size(), sizeof(glm::vec3), kMaxVertices,
                                        shared::kMaxClusterTriangles, 0));
  double meshletArea = 0;
  for (const meshopt_Meshlet& meshlet : meshlets) {
    glm::vec3 lo(1e9f), hi(-1e9f);
    for (unsigned i = 0; i < meshlet.vertex_count; ++i) {
      lo = glm::min(lo, source.positions[vertices[meshlet.vertex_offset + i]]);
      hi = glm::max(hi, source.positions[vertices[meshlet.vertex_offset + i]]);
    }
    meshletArea += halfArea(lo, hi);
  }
  EXPECT_LT(area, meshletArea);
  EXPECT_LT(count, meshlets.size() * 3 / 2);
}

TEST(Provoking, LeavesHardlyAVertexUnused) {
  // A closed mesh: half as many vertices as triangles, so that half of the triangles need a duplicate.
  Primitive source = torus(100);
  const std::size_t triangles = source.indices.size() / 3;
  const std::vector<std::uint32_t> duplicates = assignProvokingVertices(source.indices, 10'000);
  EXPECT_LE(10'000 + duplicates.size(), triangles * 102 / 100);
  std::set<std::uint32_t> firsts;
  for (std::size_t t = 0; t < triangles; ++t) EXPECT_TRUE(firsts.insert(source.indices[3 * t]).second);
}

TEST(Textures, ComeToOneSize) {
  SceneBuilder builder("test");
  builder.addMaterial(plain());
  builder.addTexture({{4, 2}, std::vector<glm::u8vec4>(8, {10, 20, 30, 255})});
  builder.addTexture({{2, 3}, std::vector<glm::u8vec4>(6, {200, 100, 50, 128})});
  builder.addTexture({{1, 2048}, std::vector<glm::u8vec4>(2048, {255, 255, 255, 255})});
  const Result<Scene> scene = std::move(builder).finish();
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->textureSize, glm::uvec2(4, 1024));
  // A texture of one colour keeps it at any size.
  const std::array<glm::u8vec4, 3> colours{{{10, 20, 30, 255}, {200, 100, 50, 128}, {255, 255, 255, 255}}};
  for (std::size_t i = 0; i < 3; ++i)
    for (const glm::u8vec4& texel : scene->textures[i])
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(texel[c], colours[i][c], 1) << "texture " << i;
}

TEST(Textures, HolesDoNotDarkenWhatIsBesideThem) {
  // Black, fully transparent texels between white ones.
  Texture texture{{8, 1}, {}};
  for (int i = 0; i < 8; ++i) texture.texels.push_back(i % 2 == 0 ? glm::u8vec4(255) : glm::u8vec4(0));
  for (const glm::u8vec4& texel : resizeTexture(texture, {4, 1}).texels) {
    EXPECT_GT(texel.r, 250);
    EXPECT_NEAR(texel.a, 128, 33);
  }
}

TEST(Textures, AreRefusedWithoutTheirTexels) {
  SceneBuilder builder("test");
  builder.addTexture({{4, 2}, std::vector<glm::u8vec4>(7)});
  EXPECT_FALSE(std::move(builder).finish());
}

// A scene of one mesh whose clusters fill these boxes.
Scene boxed(const std::vector<Bounds>& boxes) {
  Scene scene;
  const glm::dvec3 origin = boxes.front().min;
  for (const Bounds& box : boxes)
    scene.clusters.push_back(
        {.boundsMin = glm::vec3(box.min - origin), .boundsMax = glm::vec3(box.max - origin)});
  scene.meshes.push_back({.clusterCount = static_cast<std::uint32_t>(boxes.size())});
  scene.instances.push_back({.worldFromMesh = glm::translate(glm::dmat4(1), origin), .mesh = 0});
  scene.bounds = boxes.front();
  for (const Bounds& box : boxes)
    scene.bounds = {glm::min(scene.bounds.min, box.min), glm::max(scene.bounds.max, box.max)};
  return scene;
}

TEST(DefaultView, ShowsAllFromAsNearAsItCan) {
  const std::vector<std::vector<Bounds>> cases{
      {{{-1, -1, -1}, {1, 1, 1}}},
      {{{-100, 0, -100}, {100, 0, 100}}},
      {{{0, 0, 0}, {0, 50, 0}}},
      {{{1e6, 1e6, 1e6}, {1e6 + 1, 1e6 + 30, 1e6 + 2}}},
      // A box around these two is mostly empty.
      {{{-50, -9, 40}, {-48, -8, 41}}, {{40, 8, -50}, {41, 9, -48}}}};
  for (const std::vector<Bounds>& boxes : cases) {
    const Scene scene = boxed(boxes);
    const View view = defaultView(scene);
    EXPECT_GT(view.eye.y, scene.bounds.centre().y);
    const glm::dvec3 forward = glm::normalize(view.target - view.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, view.up)), up = glm::cross(right, forward);
    const double tangent = std::tan(glm::radians(view.verticalFovDegrees / 2));
    glm::dvec2 low(1), high(-1);  // in the picture
    for (const Bounds& box : boxes)
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                           corner & 4 ? box.max.z : box.min.z);
        const double depth = glm::dot(p - view.eye, forward);
        EXPECT_GT(depth, 0);
        const glm::dvec2 at =
            glm::dvec2(glm::dot(p - view.eye, right), glm::dot(p - view.eye, up)) / (depth * tangent);
        low = glm::min(low, at);
        high = glm::max(high, at);
      }
    EXPECT_TRUE(low.x >= -1 && low.y >= -1 && high.x <= 1 && high.y <= 1);
    EXPECT_GT(std::max(high.x - low.x, high.y - low.y), 1.85) << "a margin of 5 %, in one direction";
  }
}

TEST(DefaultLight, IsASunAtFiftyDegrees) {
  const Light light = defaultLight(Scene{});
  EXPECT_EQ(light.kind, LightKind::directional);
  EXPECT_NEAR(glm::length(light.direction), 1, 1e-12);
  EXPECT_NEAR(glm::degrees(std::asin(-light.direction.y)), 50, 1e-9);
}

}  // namespace
}  // namespace sundial
