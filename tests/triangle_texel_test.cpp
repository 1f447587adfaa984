// What 128 bits keep of a triangle, and what is made of it: the same functions that the shaders run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "shared/silhouette.h"
#include "shared/triangle_texel.h"

namespace sundial::shared {
namespace {

double degreesOf(double slope) { return std::atan(slope) * 180 / std::numbers::pi; }

// A map of the sun, with proportions that codes don't notice.
constexpr TexelMetric kSunMetric{{1, 1}, 1, 0, false};

double angleError(double degrees) {
  const double slope = std::tan(degrees * std::numbers::pi / 180);
  return std::abs(degreesOf(slopeOfCode(static_cast<float>(codeOfSlope(static_cast<float>(slope))))) -
                  degrees);
}

TEST(TriangleTexel, SlopesAreFineWherePlanesAreSteep) {
  double most = 0;
  for (int i = 0; i <= 2000; ++i) most = std::max(most, angleError(79.5 + i * 0.0005));
  EXPECT_LE(most, 0.12);
  EXPECT_GT(most, 0.10);  // half of the distance between two codes there
  EXPECT_LE(angleError(85), 0.09);
  EXPECT_LE(angleError(-80), 0.12);
  // Flat planes pay for it: the code beside that of no slope stands for 34 degrees.
  EXPECT_EQ(codeOfSlope(0), 127u);
  EXPECT_EQ(slopeOfCode(127), 0);
  EXPECT_NEAR(degreesOf(slopeOfCode(128)), 34.2, 0.1);
}

TEST(TriangleTexel, SlopesHaveTheirOwnCodes) {
  for (unsigned code = 1; code <= 253; ++code) {
    EXPECT_EQ(codeOfSlope(slopeOfCode(static_cast<float>(code))), code);
    EXPECT_NEAR(slopeOfCode(static_cast<float>(code)), -slopeOfCode(static_cast<float>(254 - code)),
                1e-4 * std::abs(slopeOfCode(static_cast<float>(code))));
  }
  for (const float steep : {1e9f, 1e30f}) {
    EXPECT_EQ(codeOfSlope(steep), 253u);
    EXPECT_EQ(codeOfSlope(-steep), 1u);
  }
}

TEST(TriangleTexel, CornersAndDepthComeBackAsFineAsTheirCodes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> onMap(-kCornerMargin, 1 + kCornerMargin), depth(0, 1);
  for (int i = 0; i < 1000; ++i) {
    MapTriangle t;
    for (vec2& corner : t.corners) corner = {onMap(random), onMap(random)};
    t.depth = depth(random);
    t.slope = vec2(0);
    const uvec4 texel = packedTriangle(t, kSunMetric);
    const float half = 0.501f * (1 + 2 * kCornerMargin) / kCornerSteps;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(cornerOfCode(texel[c]).x, t.corners[c].x, half);
      EXPECT_NEAR(cornerOfCode(texel[c]).y, t.corners[c].y, half);
    }
    EXPECT_NEAR(depthOfCode(texel.w >> 16, kSunMetric), t.depth, 0.51f / kDepthSteps);
    EXPECT_NE(texel.w >> 16, 0u);
    EXPECT_EQ(texel.w & 0xffffu, 127u << 8 | 127u);
  }
}

// Of a light with a place, from a tenth of a metre to a hundred: any distance comes back to the same share of
// it.
TEST(TriangleTexel, DistancesFromALightKeepTheSameShare) {
  constexpr TexelMetric metric{{2, 2}, 10, 0.01f, true};
  for (float distance = 0.1f; distance <= 100; distance *= 1.1f) {
    const float depth = (1 / distance - metric.far) / (metric.near - metric.far);
    const float back = depthOfCode(codeOfDepth(depth, metric), metric);
    EXPECT_NEAR(lsDepthOf(back, metric) * distance, 1, 0.52f * std::log(1000.0f) / kDepthSteps + 2e-5f);
    EXPECT_LE(std::abs(back - depth), 0.52f / kDepthSteps * depthPerShare(depth, metric) + 2e-7f) << distance;
  }
  EXPECT_EQ(depthOfCode(codeOfDepth(2, metric), metric), kBefore);
  EXPECT_EQ(codeOfDepth(-1, metric), 1u);
}

// A plane that leans by 60 degrees has the same code in a map of the whole scene, in a tile of it, and at any
// distance from a lamp.
TEST(TriangleTexel, SlopesAreThoseOfTheWorld) {
  const float lean = std::tan(std::numbers::pi_v<float> / 3);
  const auto codeIn = [](vec2 slope, float depth, const TexelMetric& metric) {
    MapTriangle t;
    for (vec2& corner : t.corners) corner = vec2(0.5f);
    t.depth = depth;
    t.slope = slope;
    return packedTriangle(t, metric).w & 0xffffu;
  };
  const unsigned expected = codeOfSlope(lean) << 8 | codeOfSlope(0);
  // Light space in metres, of 40 metres' depth.
  for (const float side : {200.0f, 40.0f, 0.5f})
    EXPECT_EQ(codeIn({lean * side / 40, 0}, 0.5f, {{side, side}, 50, 10, false}), expected) << side;
  // On the axis of a spot light the plane d + lean * x = distance has the reciprocal (1 + lean * x / d) /
  // distance.
  constexpr TexelMetric spot{{1.5f, 1.5f}, 5, 0.02f, true};
  for (const float distance : {0.3f, 2.0f, 30.0f}) {
    const float perDepth = 1 / (spot.near - spot.far);
    EXPECT_EQ(
        codeIn({lean / distance * spot.side.x * perDepth, 0}, (1 / distance - spot.far) * perDepth, spot),
        expected)
        << distance;
  }
}

// A corner beyond the grid moves along the edge that passes by the texel, so that this edge doesn't turn.
TEST(TriangleTexel, CornersBeyondTheGridKeepTheEdgeThatIsNear) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> inside(0.1f, 0.9f), far(2, 40);
  for (int i = 0; i < 1000; ++i) {
    const vec2 near(inside(random), inside(random));
    const vec2 away(far(random), far(random) - 20), other(far(random), far(random) + 30);
    const vec2 texel = near + 0.02f * (away - near);  // on the edge from near to away
    const vec2 kept = cornerOnGrid(away, near, other, texel);
    EXPECT_LE(std::abs(kept.x - 0.5f), 0.5f + kCornerMargin + 1e-4f);
    EXPECT_LE(std::abs(kept.y - 0.5f), 0.5f + kCornerMargin + 1e-4f);
    EXPECT_LT(std::sqrt(lineDistance2(texel, near, kept)), 1e-4f);
  }
}

// Of a triangle with corners beyond the grid, what is kept is the same about the texel; seldom where two of
// its edges pass through the square.
TEST(TriangleTexel, LargeTrianglesAreTheSameAboutTheirTexel) {
  constexpr float kHalf = 0.004f;
  std::mt19937 random(6);
  std::uniform_real_distribution<float> unit(0, 1), about(-kHalf, kHalf);
  for (const float reach : {0.5f, 1.0f, 3.0f, 30.0f}) {
    std::uniform_real_distribution<float> anywhere(-reach, 1 + reach);
    int crossed = 0, covered = 0, wrong = 0;
    for (int i = 0; i < 30000; ++i) {
      MapTriangle t;
      for (vec2& corner : t.corners) corner = {anywhere(random), anywhere(random)};
      t.depth = 0.5f;
      t.slope = vec2(0);
      const vec2 texel(unit(random), unit(random));
      if (std::ranges::all_of(t.corners, isOnGrid) || !containsPoint(t.corners, texel, vec2(0))) continue;
      const uvec4 packed = packedTriangle(onGrid(t, texel, vec2(kHalf)), kSunMetric);
      vec2 kept[3];
      for (int c = 0; c < 3; ++c) kept[c] = cornerOfCode(packed[c]);
      const auto toEdge = [&](vec2 p) {
        float nearest = 1;
        for (int c = 0; c < 3; ++c)
          nearest = std::min(nearest, std::sqrt(lineDistance2(p, t.corners[c], t.corners[(c + 1) % 3])));
        return nearest;
      };
      (toEdge(texel) < kHalf ? crossed : covered) += 1;
      bool same = true;
      for (int k = 0; k < 20; ++k) {
        const vec2 p = texel + vec2(about(random), about(random));
        same = same && (toEdge(p) <= 2e-4f ||
                        containsPoint(kept, p, vec2(0)) == containsPoint(t.corners, p, vec2(0)));
      }
      wrong += same ? 0 : 1;
    }
    EXPECT_LE(wrong, (crossed + covered) / 1000) << reach;
    EXPECT_GT(crossed, 5);
    EXPECT_GT(covered, 500);
  }
}

// The greatest depth of a triangle within its texel, by trying many places.
TEST(Silhouette, TheNearestPointIsOnTheTriangleAndNoneIsNearer) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> wide(-1.5f, 1.5f), unit(0, 1), inTexel(-0.5f, 0.5f);
  int covered = 0;
  for (int i = 0; i < 3000; ++i) {
    TexelTriangle t;
    for (vec2& corner : t.corners) corner = {wide(random), wide(random)};
    t.depth = unit(random);
    t.slope = {wide(random), wide(random)};
    float greatest = -100;
    for (int k = 0; k < 400; ++k) {
      const vec2 at(inTexel(random), inTexel(random));
      if (containsPoint(t.corners, at, vec2(0))) greatest = std::max(greatest, planeDepth(t, at));
    }
    if (greatest < -50) continue;
    ++covered;
    const vec2 nearest = nearestPoint(t);
    EXPECT_LE(std::max(std::abs(nearest.x), std::abs(nearest.y)), 0.5001f);
    EXPECT_GE(planeDepth(t, nearest), greatest - 1e-5f);
    // On it, but for rounding.
    const vec2 centroid = (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0f;
    EXPECT_TRUE(containsPoint(t.corners, nearest + 1e-4f * (centroid - nearest), vec2(0)));
  }
  EXPECT_GT(covered, 1000);
}

// Directions of a pattern's edges, 16ths of a turn.
std::vector<unsigned> edgesIn(std::initializer_list<unsigned> shadowed) {
  unsigned bits = 0;
  for (const unsigned i : shadowed) bits |= 1u << i;
  const unsigned code = edgesOfPattern(bits);
  std::vector<unsigned> edges;
  for (unsigned i = 0; i < (code & 7u); ++i) edges.push_back(code >> (3 + 4 * i) & 15u);
  return edges;
}

TEST(Silhouette, PatternsTellWhereTheLightLies) {
  using Edges = std::vector<unsigned>;
  EXPECT_EQ(edgesIn({0, 1, 2, 3, 4}), Edges{12});         // the lower row is lit: light below
  EXPECT_EQ(edgesIn({2, 3, 4, 5, 6}), Edges{0});          // right column lit
  EXPECT_EQ(edgesIn({4, 5, 6}), Edges{2});                // light at the upper right
  EXPECT_EQ(edgesIn({0, 2, 3, 4, 5, 6, 7}), Edges{2});    // one lit corner
  EXPECT_EQ(edgesIn({2, 6}), (Edges{8, 0}));              // a bar: lit on both sides
  EXPECT_EQ(edgesIn({2, 1, 3, 5, 6, 7}), (Edges{0, 8}));  // a broad one
  EXPECT_EQ(edgesIn({4, 3, 1}), edgesIn({4, 3}));         // a corner of its own doesn't count
  EXPECT_EQ(edgesIn({1, 3, 5, 7}), Edges{});              // nor do four
  EXPECT_EQ(edgesIn({0, 1, 2, 3, 4, 5, 6, 7}), Edges{});
  EXPECT_EQ(edgesIn({0, 2, 4, 6}).size(), 4u);
  for (unsigned pattern = 0; pattern < 256; ++pattern) EXPECT_LE(edgesOfPattern(pattern) & 7u, 4u);
}

EdgeFunction through(const std::vector<vec2>& points) {
  EdgeFunction f = emptyEdge();
  for (int pass = 0; pass < 3; ++pass)
    for (const vec2& p : points) f = with(f, p);
  return f;
}

TEST(Silhouette, TheEdgeIsTheLowestLineAcross) {
  EXPECT_FLOAT_EQ(valueAt(through({{-1, 2}, {1, 4}}), 0), 3);
  EXPECT_FLOAT_EQ(valueAt(through({{-1, 2}, {1, 4}}), 0.5f), 3.5f);
  // What lies behind doesn't count, whenever it comes.
  EXPECT_FLOAT_EQ(valueAt(through({{-0.5f, 9}, {-1, 2}, {0.2f, 7}, {1, 4}, {-0.1f, 3.5f}}), 0), 3);
  EXPECT_FLOAT_EQ(valueAt(through({{0, 1}, {-1, 2}, {1, 4}}), 0), 1);
  const EdgeFunction half = through({{-1, 2}, {-2, 5}});
  EXPECT_TRUE(half.hasLeft && !half.hasRight);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> wide(-2, 2);
  int exact = 0;
  for (int i = 0; i < 500; ++i) {
    std::vector<vec2> points(12);
    for (vec2& p : points) p = {wide(random), wide(random)};
    float lowest = 100;
    for (const vec2& a : points)
      for (const vec2& b : points)
        if (a.x < 0 && b.x > 0) lowest = std::min(lowest, a.y - a.x * (b.y - a.y) / (b.x - a.x));
    const EdgeFunction f = through(points);
    if (!f.hasLeft || !f.hasRight) continue;
    EXPECT_GE(valueAt(f, 0), lowest - 1e-5f);
    exact += valueAt(f, 0) <= lowest + 1e-4f;
  }
  EXPECT_GT(exact, 480);
}

}  // namespace
}  // namespace sundial::shared
