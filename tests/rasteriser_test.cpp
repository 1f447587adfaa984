// The compute rasteriser covers the texels that exact arithmetic says it must, and no other.
#include <fmt/format.h>

#include <random>

#include "support/device_test.h"
#include "support/raster_stage.h"

namespace sundial::test {
namespace {

// What a triangle adds to a texel: keep_sum.glsl.
std::uint32_t numberOf(std::uint32_t id) { return (id + 1) * shared::kSumFactor; }

// Triangles of every awkward kind about a map, in clip space.
class Triangles {
 public:
  Triangles(unsigned seed, Projection projection, glm::uvec2 map)
      : random_(seed), projection_(projection), map_(map) {}

  Soup make(std::size_t count) {
    Soup soup;
    for (std::size_t i = 0; i < count; ++i) add(soup, static_cast<Kind>(i % kKinds), i);
    return soup;
  }

 private:
  enum Kind { tiny, small, medium, sliver, collinear, pointlike, aligned, border, huge };
  static constexpr std::size_t kKinds = 9;

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  glm::dvec2 within(double margin) {
    return {uniform(-margin, map_.x + margin), uniform(-margin, map_.y + margin)};
  }
  glm::dvec2 around(const glm::dvec2& centre, double reach) {
    return centre + glm::dvec2(uniform(-reach, reach), uniform(-reach, reach));
  }

  // Corners in texels of the map.
  std::array<glm::dvec2, 3> corners(Kind kind, std::size_t i) {
    const glm::dvec2 a = within(8);
    switch (kind) {
      case tiny:
        return {a, around(a, 0.7), around(a, 0.7)};
      case small:
        return {a, around(a, 5), around(a, 5)};
      case medium:
        return {a, around(a, 60), around(a, 60)};
      case sliver: {
        const glm::dvec2 b = around(a, uniform(1, 150));
        return {a, b,
                glm::mix(a, b, uniform(-0.5, 1.5)) + glm::dvec2(uniform(-0.02, 0.02), uniform(-0.02, 0.02))};
      }
      case collinear: {
        const glm::dvec2 b = around(a, 30);
        return {a, b, glm::mix(a, b, uniform(-1, 2))};
      }
      case pointlike:
        return {a, a, i % 2 ? a : around(a, 2)};
      case aligned: {
        // On centres and sides of texels, or on the grid between.
        const auto snapped = [&](const glm::dvec2& p, double steps) { return glm::round(p * steps) / steps; };
        const double steps = i % 4 < 2 ? 2 : 256;
        const glm::dvec2 b = snapped(around(a, 9), steps), c = snapped(around(a, 9), steps);
        return {snapped(a, steps), i % 3 ? b : glm::dvec2(b.x, snapped(a, steps).y), c};
      }
      case border: {
        const glm::dvec2 edge(uniform(0, 1) < 0.5 ? 0 : map_.x, uniform(0, 1) < 0.5 ? 0 : map_.y);
        return {around(edge, 3), around(edge, 30), around(edge, 30)};
      }
      case huge:
        // One in sixteen: each covers much of the map.
        if (i % 16) return {a, around(a, 2), around(a, 2)};
        return {within(3000), within(3000), within(300)};
    }
    return {};
  }

  void add(Soup& soup, Kind kind, std::size_t i) {
    const std::array<glm::dvec2, 3> texels = corners(kind, i);
    const double scale = uniform(0.3, 3);
    for (const glm::dvec2& p : texels) {
      const glm::dvec2 ndc = 2.0 * p / glm::dvec2(map_) - 1.0;
      // A fifth of the corners lie behind the light, or so near its plane that they are far outside.
      const double w = projection_ == Projection::parallel     ? 1
                       : uniform(0, 1) < 0.2 && kind >= medium ? uniform(-1, 0.1)
                                                               : scale * uniform(0.9, 1.1);
      soup.positions.emplace_back(ndc * w, projection_ == Projection::parallel ? uniform(-0.5, 1.5) : w);
    }
  }

  std::mt19937 random_;
  Projection projection_;
  glm::uvec2 map_;
};

class RasteriserTest : public DeviceTest<> {
 protected:
  static RasterStage& stage() {
    static RasterStage instance(device());
    return instance;
  }

  // Texels of all maps whose sum over all triangles isn't the exact one.
  static std::size_t wrongTexels(const Soup& soup, Projection projection, const std::vector<MapRect>& maps,
                                 Coverage coverage) {
    const std::vector<std::uint32_t> drawn = stage().draw(
        soup, projection, maps,
        {.sums = true,
         .coverage = coverage == Coverage::centre ? shared::kCoverCentre : shared::kCoverConservative});
    std::vector<std::uint32_t> exact(drawn.size());
    std::uint32_t first = 0;
    for (const MapRect& map : maps) {
      for (std::uint32_t t = 0; t < soup.positions.size() / 3; ++t)
        rasterise(clipOf(soup, t, projection), map, coverage,
                  [&](glm::uvec2 texel) { exact[first + texel.y * map.size.x + texel.x] += numberOf(t); });
      first += map.size.x * map.size.y;
    }
    std::size_t wrong = 0, covered = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      wrong += drawn[i] != exact[i];
      covered += exact[i] != 0;
    }
    EXPECT_GT(covered, exact.size() / 2);
    return wrong;
  }
};

class Fuzz : public RasteriserTest, public ::testing::WithParamInterface<std::pair<Projection, Coverage>> {};

TEST_P(Fuzz, FiftyThousandTrianglesCoverWhatExactArithmeticSays) {
  const auto [projection, coverage] = GetParam();
  const glm::uvec2 size(152, 100);
  const Soup soup = Triangles(7, projection, size).make(50'000);
  EXPECT_EQ(wrongTexels(soup, projection, {{{0, 0}, size}}, coverage), 0u);
  EXPECT_EQ(stage().triangles(), 50'000u);
}

TEST_P(Fuzz, LargeTrianglesOfALargeMapAreWholeToo) {
  const auto [projection, coverage] = GetParam();
  const glm::uvec2 size(1500, 700);
  EXPECT_EQ(wrongTexels(Triangles(3, projection, size).make(960), projection, {{{0, 0}, size}}, coverage),
            0u);
}

TEST_P(Fuzz, MapsOfUnequalSizesInOneBufferDontMix) {
  const auto [projection, coverage] = GetParam();
  const Soup soup = Triangles(11, projection, {64, 64}).make(900);
  EXPECT_EQ(wrongTexels(soup, projection,
                        {{{0, 0}, {64, 64}}, {{0, 0}, {16, 16}}, {{3000, 70}, {100, 37}}, {{5, 9}, {8, 300}}},
                        coverage),
            0u);
}

INSTANTIATE_TEST_SUITE_P(Both, Fuzz,
                         ::testing::Values(std::pair(Projection::parallel, Coverage::centre),
                                           std::pair(Projection::parallel, Coverage::conservative),
                                           std::pair(Projection::perspective, Coverage::centre),
                                           std::pair(Projection::perspective, Coverage::conservative)));

// The judge itself, on a triangle whose coverage is known by hand.
TEST(ExactRaster, KnowsAnEdgeThroughCentres) {
  const GridTriangle t{GridPoint(0, 0), GridPoint(512, 0), GridPoint(0, 512)};
  // Its top and left edges pass through centres and count; the long one doesn't.
  EXPECT_TRUE(covers(t, {0, 0}, Coverage::centre));
  EXPECT_TRUE(covers(t, {1, 0}, Coverage::centre));
  EXPECT_FALSE(covers(t, {2, 0}, Coverage::centre));
  EXPECT_FALSE(covers(t, {1, 1}, Coverage::centre));
  EXPECT_TRUE(covers(t, {1, 1}, Coverage::conservative));
  EXPECT_TRUE(covers(t, {2, 0}, Coverage::conservative));
  EXPECT_FALSE(covers(t, {2, 2}, Coverage::conservative));
  EXPECT_FALSE(covers(t, {3, 0}, Coverage::conservative));
}

TEST_F(RasteriserTest, ListsThatAreTooShortAreMadeLongerAndAllIsDrawn) {
  const glm::uvec2 size(64, 64);
  Soup soup;
  // Many more clipped triangles than there is room for at first, each of its own texel.
  for (int i = 0; i < 70'000; ++i) {
    const float y = -1 + 2 * (static_cast<float>(i % 64) + 0.5f) / 64;
    soup.positions.insert(soup.positions.end(),
                          {{-1.5f, y - 0.01f, 0.5f}, {1.5f, y - 0.01f, 0.5f}, {1.5f, y + 0.05f, 0.5f}});
  }
  EXPECT_EQ(wrongTexels(soup, Projection::parallel, {{{0, 0}, size}}, Coverage::centre), 0u);
  EXPECT_EQ(stage().rounds(), 2u);
}

TEST_F(RasteriserTest, ATexelHoldsTheNearestDepthAndWhoseItIs) {
  Soup soup = quad({-0.5f, -0.5f, 0.25f}, {1, 0, 0}, {0, 1, 0});
  for (const Soup& more :
       {quad({-0.5f, -0.5f, 0.75f}, {0.5f, 0, 0}, {0, 1, 0}), quad({-1, -1, 0.5f}, {2, 0, 0}, {0, 2, 0})})
    soup.positions.insert(soup.positions.end(), more.positions.begin(), more.positions.end());
  soup.uvs.clear();
  const auto words = stage().draw(soup, Projection::parallel, {{{0, 0}, {64, 64}}}, {.ids = true});
  const auto at = [&](std::size_t x, std::size_t y) {
    float depth;
    std::memcpy(&depth, &words[2 * (y * 64 + x) + 1], sizeof depth);
    return std::pair(words[2 * (y * 64 + x)] / 2, depth);  // a quad has two triangles
  };
  EXPECT_EQ(at(20, 30), std::pair(1u, 0.75f));
  EXPECT_EQ(at(40, 30), std::pair(2u, 0.5f));
  EXPECT_EQ(at(2, 2), std::pair(2u, 0.5f));
}

TEST_F(RasteriserTest, ConservativeDepthIsTheNearestOfThePlaneInTheTexel) {
  // Depth falls from 1 at the left to 0 at the right of 64 texels.
  const Soup soup = quad({-1, -1, 1}, {2, 0, -1}, {0, 2, 0});
  for (const auto& [coverage, at] :
       {std::pair(shared::kCoverCentre, 0.5), {shared::kCoverConservative, 0.0}}) {
    const auto words = stage().draw(soup, Projection::parallel, {{{0, 0}, {64, 64}}}, {.coverage = coverage});
    for (std::size_t x = 0; x < 64; ++x) {
      float depth;
      std::memcpy(&depth, &words[10 * 64 + x], sizeof depth);
      EXPECT_NEAR(depth, 1 - (static_cast<double>(x) + at) / 64, 1e-6);
    }
  }
}

}  // namespace
}  // namespace sundial::test
