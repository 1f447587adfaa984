// The reference against shadows that are known in closed form, and against itself.
#include "reference/reference.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

#include "support/tiny_scene.h"

namespace sundial::test {
namespace {

using shared::ViewSample;

constexpr float kGround = 4;  // half of its side

// Triangles 0 and 1 as instance 0, facing up at y = 0.
Soup ground() { return quad({-kGround, 0, -kGround}, {0, 0, 2 * kGround}, {2 * kGround, 0, 0}); }

ViewSample onGround(float x, float z) { return {glm::vec3(x, 0, z), 0, glm::vec3(0, 1, 0), z > x ? 0u : 1u}; }

std::vector<ViewSample> groundSamples(int side) {
  std::vector<ViewSample> samples;
  const float step = 2 * kGround / static_cast<float>(side);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      samples.push_back(onGround((static_cast<float>(column) + 0.5f) * step - kGround,
                                 (static_cast<float>(row) + 0.5f) * step - kGround));
  return samples;
}

Light sun(glm::dvec3 direction) { return {LightKind::directional, glm::normalize(direction), {}, 0}; }

std::vector<float> traced(const Reference& reference, const std::vector<ViewSample>& samples,
                          const Light& light, glm::dvec3 origin = glm::dvec3(0), std::uint32_t width = 0) {
  std::vector<float> visibility(samples.size(), -1);
  reference.trace(samples, light, origin, visibility, width);
  return visibility;
}
std::vector<float> traced(const std::shared_ptr<const Scene>& scene, const std::vector<ViewSample>& samples,
                          const Light& light, glm::dvec3 origin = glm::dvec3(0)) {
  return traced(Reference(scene), samples, light, origin);
}

// Where the ray from a ground sample towards the light crosses the height.
glm::dvec2 crossing(const ViewSample& sample, const Light& light, double height) {
  const glm::dvec3 p(sample.wsPosition);
  const glm::dvec3 d = light.kind == LightKind::directional ? -light.direction : light.position - p;
  const glm::dvec3 q = p + d * (height / d.y);
  return {q.x, q.z};
}

// Positive outside [low, high]^2, by the distance in the maximum norm.
double outside(glm::dvec2 q, double low, double high) {
  return std::max({low - q.x, q.x - high, low - q.y, q.y - high});
}

// Expects R = 0 where `signedDistance` is negative, 1 where it is positive, away from the edge itself.
void expectShadow(const std::vector<float>& visibility, const std::vector<ViewSample>& samples,
                  const std::function<double(const ViewSample&)>& signedDistance) {
  int wrong = 0, lit = 0, shadowed = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double distance = signedDistance(samples[i]);
    if (std::abs(distance) < 2e-6) continue;
    (distance > 0 ? lit : shadowed) += 1;
    wrong += visibility[i] != (distance > 0 ? 1.0f : 0.0f);
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(lit, 0);
  EXPECT_GT(shadowed, 0);
}

constexpr float kHeight = 1;

// The ground and a square of two metres a side above its middle.
std::shared_ptr<const Scene> squareAboveGround() {
  TinyScene scene;
  scene.addInstance(scene.addMesh(ground()));
  scene.addInstance(scene.addMesh(quad({-1, kHeight, -1}, {2, 0, 0}, {0, 0, 2})));
  return scene.finish();
}

TEST(Reference, CastsASquaresShadowFromTheSun) {
  const Light light = sun({0.3, -1, 0.2});
  const auto samples = groundSamples(301);
  expectShadow(traced(squareAboveGround(), samples, light), samples,
               [&](const ViewSample& s) { return outside(crossing(s, light, kHeight), -1, 1); });
}

TEST(Reference, CastsASquaresShadowFromASpotAndFromAPoint) {
  Light light{LightKind::spot, glm::dvec3(0, -1, 0), glm::dvec3(0.4, 3, -0.2), 170};
  const auto samples = groundSamples(301);
  for (const LightKind kind : {LightKind::spot, LightKind::point}) {
    light.kind = kind;
    expectShadow(traced(squareAboveGround(), samples, light), samples,
                 [&](const ViewSample& s) { return outside(crossing(s, light, kHeight), -1, 1); });
  }
}

TEST(Reference, IsTheSameWhetherASquareFacesTheLightOrNot) {
  TinyScene flipped;
  flipped.addInstance(flipped.addMesh(ground()));
  flipped.addInstance(flipped.addMesh(quad({-1, kHeight, -1}, {0, 0, 2}, {2, 0, 0})));
  const auto samples = groundSamples(101);
  const Light light = sun({0.3, -1, 0.2});
  EXPECT_EQ(traced(flipped.finish(), samples, light), traced(squareAboveGround(), samples, light));
}

TEST(Reference, IgnoresWhatLiesBehindALightAtAPlace) {
  const auto samples = groundSamples(51);
  for (const LightKind kind : {LightKind::spot, LightKind::point}) {
    const Light below{kind, glm::dvec3(0, -1, 0), glm::dvec3(0, 0.9, 0), 170};
    const auto visibility = traced(squareAboveGround(), samples, below);
    EXPECT_TRUE(std::ranges::all_of(visibility, [](float v) { return v == 1; }) || kind == LightKind::spot);
    EXPECT_EQ(visibility[samples.size() / 2], 1);
  }
}

TEST(Reference, LightsOnlyTheConeOfASpot) {
  TinyScene scene;
  scene.addInstance(scene.addMesh(ground()));
  const Light light{LightKind::spot, glm::dvec3(0, -1, 0), glm::dvec3(0, 2, 0), 60};
  const auto samples = groundSamples(201);
  const double radius = 2 * std::tan(glm::radians(30.0));
  expectShadow(traced(scene.finish(), samples, light), samples,
               [&](const ViewSample& s) { return radius - std::hypot(s.wsPosition.x, s.wsPosition.z); });
}

TEST(Reference, IsDarkWhereASampleTurnsAwayOrShowsNoGeometry) {
  std::vector<ViewSample> samples = {onGround(3, 3), onGround(3, 3), onGround(3, 3), onGround(3, 3)};
  samples[1].wsNormal = {0, -1, 0};
  samples[2].wsNormal = {1, 0, 0};  // at a right angle to the light
  samples[3].instance = shared::kNoInstance;
  const Light light = sun({0, -1, 0});
  EXPECT_EQ(traced(squareAboveGround(), samples, light), (std::vector<float>{1, 0, 0, 0}));
  std::vector<std::uint8_t> faces(samples.size());
  facesLight(samples, light, glm::dvec3(0), faces);
  EXPECT_EQ(faces, (std::vector<std::uint8_t>{1, 0, 0, 0}));
  EXPECT_TRUE(facesLight(samples[0], light, glm::dvec3(0)));
}

// A sample a little below its own triangle meets it on the way to the light.
std::vector<ViewSample> below(std::vector<ViewSample> samples, float depth) {
  for (ViewSample& s : samples) s.wsPosition.y -= depth;
  return samples;
}
int litCount(const std::vector<float>& visibility) {
  return static_cast<int>(std::accumulate(visibility.begin(), visibility.end(), 0.0f));
}

constexpr float kBelow = 5e-3f;  // beyond 2e-5 of the diagonal of 11.3 m, and too far for a coplanar triangle

TEST(Reference, IgnoresTheReceiversOwnTriangle) {
  TinyScene scene;
  scene.addInstance(scene.addMesh(ground()));
  const auto reference = scene.finish();
  auto samples = below(groundSamples(40), kBelow);
  const Light light = sun({0.02, -1, 0.01});
  // Next to the diagonal the ray leaves through the neighbour, which does count.
  std::erase_if(samples,
                [](const ViewSample& s) { return std::abs(s.wsPosition.x - s.wsPosition.z) < 0.01f; });
  EXPECT_EQ(litCount(traced(reference, samples, light)), static_cast<int>(samples.size()));
  for (ViewSample& s : samples) s.triangle ^= 1;
  EXPECT_EQ(litCount(traced(reference, samples, light)), 0) << "the same samples as another triangle's";
}

TEST(Reference, IgnoresTrianglesCoincidentWithTheReceivers) {
  const Soup sheet = quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  const Soup turned = [&] {
    Soup soup = sheet;
    for (std::size_t i = 0; i < soup.positions.size(); i += 3)
      std::swap(soup.positions[i], soup.positions[i + 2]);
    return soup;
  }();
  // The same sheet again: in the same mesh, as another instance, as another mesh in other units.
  const auto twoFaces = [&](TinyScene& s) { s.addInstance(s.addMesh({{sheet, 0}, {turned, 0}})); };
  const auto twoInstances = [&](TinyScene& s) {
    const auto mesh = s.addMesh(sheet);
    s.addInstance(mesh);
    s.addInstance(mesh);
  };
  const auto twoMeshes = [&](TinyScene& s) {
    Soup inOtherUnits = turned;
    for (glm::vec3& p : inOtherUnits.positions) p = p / 0.3f + 7.0f;
    s.addInstance(s.addMesh(sheet));
    s.addInstance(s.addMesh(inOtherUnits),
                  glm::translate(glm::scale(glm::dmat4(1), glm::dvec3(0.3)), glm::dvec3(-7)));
  };
  const auto oneHigher = [&](TinyScene& s) {
    const auto mesh = s.addMesh(sheet);
    s.addInstance(mesh);
    s.addInstance(mesh, glm::translate(glm::dmat4(1), glm::dvec3(0, 3e-5, 0)));
  };
  auto samples = below(groundSamples(80), 1e-4f);
  std::erase_if(samples, [](const ViewSample& s) {
    return std::max(std::abs(s.wsPosition.x), std::abs(s.wsPosition.z)) > 0.99f ||
           std::abs(s.wsPosition.x - s.wsPosition.z) < 0.01f;
  });
  const Light light = sun({0.02, -1, 0.01});
  const auto lit = [&](const std::function<void(TinyScene&)>& build) {
    TinyScene scene;
    build(scene);
    return litCount(traced(scene.finish(), samples, light));
  };
  EXPECT_EQ(lit(twoFaces), static_cast<int>(samples.size()));
  EXPECT_EQ(lit(twoInstances), static_cast<int>(samples.size()));
  EXPECT_EQ(lit(twoMeshes), static_cast<int>(samples.size()));
  EXPECT_EQ(lit(oneHigher), 0) << "a sheet just above is not coincident";
}

TEST(Reference, IgnoresHitsNearerThanAShareOfTheDiagonal) {
  const auto litBelowASheetAt = [](double height) {
    TinyScene scene;
    scene.addInstance(scene.addMesh(ground()));
    scene.addInstance(scene.addMesh(quad({-1, 0, -1}, {2, 0, 0}, {0, 0, 2})),
                      glm::translate(glm::dmat4(1), glm::dvec3(0, height, 0)));
    return traced(scene.finish(), {onGround(0.25f, 0.5f)}, sun({0, -1, 0}))[0];
  };
  const double diagonal = std::sqrt(2.0) * 2 * kGround;
  EXPECT_EQ(litBelowASheetAt(1.9e-5 * diagonal), 1);
  EXPECT_EQ(litBelowASheetAt(2.1e-5 * diagonal), 0);
}

// No ray may slip between triangles, not even where it meets an edge or a corner exactly.
// A sample is rounded to a place below its plane; the ray rises more slowly than it would have to.
TEST(Reference, MeetsNothingBelowAPlaneThatTheLightGrazes) {
  TinyScene scene;
  scene.addInstance(scene.addMesh(ground()));
  // A wall that hangs from the ground's far edge.
  scene.addInstance(scene.addMesh(quad({kGround, 0, -kGround}, {0, -2, 0}, {0, 0, 2 * kGround})));
  std::vector<ViewSample> samples;
  for (int i = 0; i < 64; ++i) {
    samples.push_back(onGround(kGround - 0.001f * static_cast<float>(1 + i), 0.03f * static_cast<float>(i)));
    samples.back().wsPosition.y = -5e-7f;
  }
  EXPECT_EQ(litCount(traced(scene.finish(), samples, sun({-1, -5e-6, 0}))), 64);
}

TEST(Reference, DoesNotLeakThroughAClosedMesh) {
  const int rings = 16;
  const Soup ball = sphere(rings);
  TinyScene scene;
  scene.addInstance(scene.addMesh(ground()));
  scene.addInstance(scene.addMesh(ball), glm::translate(glm::dmat4(1), glm::dvec3(0, 2, 0)));
  std::vector<ViewSample> samples;
  const auto add = [&](glm::vec3 p) {
    if (std::hypot(p.x, p.z) < 0.95f) samples.push_back(onGround(p.x, p.z));
  };
  for (std::size_t i = 0; i < ball.positions.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 a = ball.positions[i + k], b = ball.positions[i + (k + 1) % 3];
      for (int step = 0; step < 16; ++step) add(glm::mix(a, b, static_cast<float>(step) / 16));
    }
  EXPECT_GT(samples.size(), 10000u);
  EXPECT_EQ(litCount(traced(scene.finish(), samples, sun({0, -1, 0}))), 0);
}

TEST(Reference, PlacesInstancesScaledUnevenlyAndMirrored) {
  // From a unit square at (0, 0) to [0.5, 2.5] x [-1.5, -1] at the height of 1: x by -2, z by 0.5.
  glm::dmat4 place = glm::translate(glm::dmat4(1), glm::dvec3(2.5, 1, -1.5));
  place = glm::scale(place, glm::dvec3(-2, 3, 0.5));
  TinyScene scene;
  scene.addInstance(scene.addMesh(ground()));
  const auto square = scene.addMesh(quad({0, 0, 0}, {1, 0, 0}, {0, 0, 1}));
  scene.addInstance(square, place);
  const Light light = sun({-0.2, -1, 0.4});
  const auto samples = groundSamples(301);
  expectShadow(traced(scene.finish(), samples, light), samples, [&](const ViewSample& s) {
    const glm::dvec2 q = crossing(s, light, 1);
    return std::max({0.5 - q.x, q.x - 2.5, -1.5 - q.y, q.y + 1.0});
  });
}

TEST(Reference, PassesThroughHolesUpToTheirEdge) {
  // Alpha falls from 1 at the centre of a '#' texel to 0 at the centre of the next: the edge, at one half, is
  // where the texels meet.
  struct Case {
    std::uint32_t wrap;
    std::function<bool(double)> hole;  // of the texture coordinate, which runs over [0, 3]
  };
  const auto fraction = [](double u) { return u - std::floor(u); };
  const Case cases[] = {
      {shared::kWrapRepeat, [=](double u) { return fraction(u) > 0.25; }},
      {shared::kWrapClamp, [](double u) { return u > 0.25; }},
      {shared::kWrapMirror,
       [=](double u) { return 0.25 < (fraction(u / 2) < 0.5 ? fraction(u) : 1 - fraction(u)); }},
  };
  const auto samples = groundSamples(301);
  const Light light = sun({0, -1, 0});
  for (const Case& c : cases) {
    TinyScene scene;
    const auto texture = scene.addTexture({"#...", "#...", "#...", "#..."});
    const auto material = scene.addMasked(1, 0.5f, texture, c.wrap);
    scene.addInstance(scene.addMesh(ground()));
    scene.addInstance(scene.addMesh({{quad({-3, 1, -3}, {6, 0, 0}, {0, 0, 6}, 3), material}}));
    expectShadow(traced(scene.finish(), samples, light), samples, [&](const ViewSample& s) {
      const glm::dvec2 q = crossing(s, light, 1);
      if (outside(q, -3, 3) > 0) return outside(q, -3, 3);
      const double u = (q.x + 3) / 2;
      const double toTexelEdge = std::abs(u * 4 - std::round(u * 4)) / 4;
      return c.hole(u) ? toTexelEdge : -toTexelEdge;
    });
  }
}

TEST(Reference, MultipliesAlphaOfFactorTextureAndVertices) {
  const auto isLit = [](float factor, const char* texel, std::uint32_t vertexAlpha, float cutoff) {
    TinyScene scene;
    const auto material = scene.addMasked(factor, cutoff, scene.addTexture({texel}), shared::kWrapRepeat);
    Soup square = quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
    square.colours.assign(square.positions.size(), vertexAlpha << 24 | 0xffffffu);
    scene.addInstance(scene.addMesh(ground()));
    scene.addInstance(scene.addMesh({{square, material}, {quad({2, 1, 2}, {1, 0, 0}, {0, 0, 1}), 0}}));
    const auto visibility =
        traced(scene.finish(), {onGround(0.25f, 0.5f), onGround(2.25f, 2.5f)}, sun({0, -1, 0}));
    EXPECT_EQ(visibility[1], 0) << "an opaque part of the same mesh has no holes";
    return visibility[0] == 1;
  };
  EXPECT_FALSE(isLit(1, "#", 255, 0.9f));
  EXPECT_TRUE(isLit(1, ".", 255, 0.9f));
  EXPECT_TRUE(isLit(0.8f, "#", 255, 0.9f));
  EXPECT_TRUE(isLit(1, "#", 51, 0.9f));
  EXPECT_FALSE(isLit(0.5f, "#", 51, 0.09f)) << "0.5 * 0.2 reaches 0.09";
  EXPECT_TRUE(isLit(0.5f, "#", 51, 0.11f)) << "0.5 * 0.2 doesn't reach 0.11";
  EXPECT_FALSE(isLit(0.5f, "#", 255, 0.5f)) << "alpha at the cutoff is kept";
}

// A ball over the ground and some squares, as seen from nowhere in particular.
std::shared_ptr<const Scene> mixedScene(const glm::dvec3& at) {
  TinyScene scene;
  const glm::dmat4 place = glm::translate(glm::dmat4(1), at);
  scene.addInstance(scene.addMesh(ground()), place);
  const auto ball = scene.addMesh(sphere(24));
  for (int i = -2; i <= 2; ++i)
    scene.addInstance(ball, glm::scale(glm::translate(place, glm::dvec3(i, 1.5, 0.3 * i)), glm::dvec3(0.5)));
  return scene.finish();
}

TEST(Reference, IsTheSameFarFromTheOrigin) {
  // A power of two, so that the numbers themselves survive the move.
  const glm::dvec3 away(131072, 0, -131072);
  const auto samples = groundSamples(200);
  const Light light = sun({0.5, -1, 0.3});
  const auto here = traced(mixedScene(glm::dvec3(0)), samples, light);
  EXPECT_EQ(traced(mixedScene(away), samples, light, away), here);
  Light spot{LightKind::spot, glm::dvec3(0, -1, 0), glm::dvec3(0, 5, 0), 90};
  const auto spotHere = traced(mixedScene(glm::dvec3(0)), samples, spot);
  spot.position += away;
  EXPECT_EQ(traced(mixedScene(away), samples, spot, away), spotHere);
  EXPECT_NE(spotHere, here);
}

TEST(Reference, RepeatsExactlyWithAnyNumberOfThreads) {
  const auto scene = mixedScene(glm::dvec3(0));
  const auto samples = groundSamples(333);
  const Light light = sun({0.5, -1, 0.3});
  const auto first = traced(Reference(scene), samples, light, glm::dvec3(0), 333);
  for (const std::size_t threads : {1, 2, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(traced(Reference(scene), samples, light, glm::dvec3(0), 333), first);
  }
}

TEST(Reference, TracesEverySampleWhateverTheWidth) {
  const Reference reference(squareAboveGround());
  const auto samples = groundSamples(37);
  const Light light = sun({0.3, -1, 0.2});
  const auto inOrder = traced(reference, samples, light);
  for (const std::uint32_t width : {1u, 3u, 4u, 37u, 100u, 5000u})
    EXPECT_EQ(traced(reference, samples, light, glm::dvec3(0), width), inOrder) << width;
}

TEST(Reference, SurvivesEmptinessAndNumbersThatAreNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const auto empty = std::make_shared<const Scene>();
  EXPECT_EQ(traced(empty, {onGround(0, 0)}, sun({0, -1, 0})), std::vector<float>{1});
  EXPECT_TRUE(traced(empty, {}, sun({0, -1, 0})).empty());

  TinyScene emptyMesh;
  emptyMesh.addInstance(emptyMesh.addMesh(Soup{}));
  emptyMesh.addInstance(emptyMesh.addMesh(ground()));
  EXPECT_EQ(traced(emptyMesh.finish(), {onGround(0, 0)}, sun({0, -1, 0})), std::vector<float>{1});

  std::vector<ViewSample> strange(6, onGround(0.25f, 0.5f));
  strange[0].wsPosition.x = nan;
  strange[1].wsPosition.y = inf;
  strange[2].wsNormal = glm::vec3(nan);
  strange[3].instance = 12345;
  strange[4].triangle = 0xfffffff0u;
  strange[4].wsPosition.y = -1e-3f;
  EXPECT_EQ(traced(squareAboveGround(), strange, sun({0, -1, 0})), std::vector<float>(6, 0));
  EXPECT_EQ(traced(squareAboveGround(), strange, sun({nan, nan, nan})), std::vector<float>(6, 0));
  const Light atTheSample{LightKind::point, {}, glm::dvec3(strange[5].wsPosition), 0};
  EXPECT_EQ(traced(squareAboveGround(), {strange[5]}, atTheSample), std::vector<float>{0});
}

}  // namespace
}  // namespace sundial::test
