// Tiles in one linear buffer: where each lies, who gets which size, and which texel answers.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "support/rendering.h"

namespace sundial::test {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

constexpr glm::uvec2 kSize{320, 200};

class FrameTiles : public RendererTest {};

TEST_F(FrameTiles, TheDefaultSizesTakeThePapersBytes) {
  const auto scene = builtin("trees?count=40");
  const Rendering r = render(scene, viewOf(*scene, "walk"), lightOf(*scene, "sun"), kSize, "iasm");
  EXPECT_EQ(r.result.storeBytes, 6'860'800u);
}

TEST_F(FrameTiles, LieOneAfterAnotherInTheOrderOfTheirSizes) {
  const auto scene = builtin("trees?count=40");
  for (const char* sizes : {"1024:512:512:256:128:128:128:128:64:64:32:32:16:16:16:16", "64:32:32:8",
                            "100:90:80:70:60:50:40:30:20", "256"}) {
    SCOPED_TRACE(sizes);
    const Rendering r = render(scene, viewOf(*scene, "walk"), lightOf(*scene, "sun"), kSize,
                               fmt::format("iasm,tile_sizes={}", sizes));
    std::uint32_t offset = 0;
    std::set<std::uint32_t> tiles;
    for (const PlanView& view : r.plan) {
      EXPECT_EQ(view.gpu.linearOffset, offset);
      EXPECT_EQ(view.gpu.rectSize.x, view.gpu.rectSize.y);
      offset += view.gpu.rectSize.x * view.gpu.rectSize.y;
      tiles.insert(view.gpu.tile);
    }
    EXPECT_EQ(tiles.size(), r.plan.size());
    EXPECT_EQ(*tiles.rbegin(), r.plan.size() - 1);
    EXPECT_EQ(r.result.storeBytes, 4u * offset);
    EXPECT_TRUE(
        std::ranges::is_sorted(r.plan, std::greater(), [](const PlanView& v) { return v.gpu.importance; }));
  }
}

TEST_F(FrameTiles, ASampleIsAnsweredByTheTileThatItLiesIn) {
  const auto scene = builtin("trees?count=40");
  for (const char* view : {"walk", "main"})
    for (const char* method : {"iasm", "iasm-forward", "iasm,tile_sizes=64:64:32:32:16:16:16:8:8"}) {
      SCOPED_TRACE(fmt::format("{} {}", view, method));
      const Rendering r = render(scene, viewOf(*scene, view), lightOf(*scene, "sun"), kSize, method);
      std::size_t answered = 0, wrong = 0;
      for (std::size_t i = 0; i < r.pixels(); ++i) {
        if (!r.answered(i)) continue;
        ++answered;
        // Of all tiles the one whose square holds the sample; on a border either may.
        const PlanView& its = r.plan[r.at<std::uint32_t>(Aov::view, i)];
        const dvec4 clip = its.shadowFromWorld * dvec4(r.position(i), 1);
        wrong += glm::any(glm::greaterThan(glm::abs(dvec2(clip)), dvec2(1.0001 * clip.w)));
      }
      EXPECT_GT(answered, 1000u);
      EXPECT_EQ(wrong, 0u);
    }
}

TEST_F(FrameTiles, ImportanceIsTheSumOfItsSamples) {
  const auto scene = builtin("trees?count=40");
  const View view = viewOf(*scene, "walk");
  const Rendering r =
      render(scene, view, lightOf(*scene, "sun"), kSize, "iasm,importance_gain=10,importance_range=20");
  const double unit = std::clamp(std::floor(4e9 / (double(kSize.x) * kSize.y * 11) - 1), 1.0, 256.0);
  std::vector<double> sums(r.plan.size()), counts(r.plan.size());
  for (std::size_t i = 0; i < r.pixels(); ++i) {
    if (!r.answered(i)) continue;
    const double depth = glm::dot(r.position(i) - view.eye, glm::normalize(view.target - view.eye));
    const auto v = r.at<std::uint32_t>(Aov::view, i);
    sums[v] += unit * (1 + 10 * std::clamp(1 - depth / 20, 0.0, 1.0));
    ++counts[v];
  }
  for (std::size_t v = 0; v < r.plan.size(); ++v) {
    // Samples on a tile's border may count for either.
    EXPECT_NEAR(r.plan[v].gpu.sampleCount, counts[v], 3) << v;
    EXPECT_NEAR(r.plan[v].gpu.importance, sums[v], 3 * 11 * unit + 1e-3 * sums[v]) << v;
  }
}

TEST_F(FrameTiles, ExtentIsTheSquaresSide) {
  const auto scene = builtin("trees?count=40");
  for (const double extent : {30.0, 77.0}) {
    const Rendering r = render(scene, viewOf(*scene, "walk"), lightOf(*scene, "sun"), kSize,
                               fmt::format("iasm,extent={}", extent));
    for (const PlanView& view : r.plan)
      EXPECT_NEAR(view.gpu.texelSize.x * static_cast<float>(view.gpu.rectSize.x), extent / 4, 1e-3 * extent);
  }
}

TEST_F(FrameTiles, TheSquareIsAsLargeAsWhatIsSeenNeeds) {
  const auto scene = builtin("trees?count=40");
  for (const char* name : {"walk", "main"})
    for (const char* light : {"sun", "low"}) {
      SCOPED_TRACE(fmt::format("{} {}", name, light));
      const Rendering r = render(scene, viewOf(*scene, name), lightOf(*scene, light), kSize, "iasm");
      // Of all samples in shares of the square's half side: the first tile's corner is its own, and one
      // touches a rim.
      const auto corner = std::ranges::find(r.plan, 0u, [](const PlanView& v) { return v.gpu.tile; });
      double farthest = 0;
      for (std::size_t i = 0; i < r.pixels(); ++i) {
        if (!r.answered(i)) continue;
        const dvec4 inFirst = corner->shadowFromWorld * dvec4(r.position(i), 1);
        const dvec2 inSquare = (dvec2(inFirst.x, -inFirst.y) - 3.0) / 4.0;  // four tiles a side
        farthest = std::max({farthest, std::abs(inSquare.x), std::abs(inSquare.y)});
      }
      EXPECT_NEAR(farthest, 1, 2e-3);
    }
}

TEST_F(FrameTiles, AColumnsCameraLooksAlongTheMiddleOfTiles) {
  const auto scene = builtin("trees?count=40");
  const View view = viewOf(*scene, "walk");
  const Rendering r = render(scene, view, lightOf(*scene, "sun"), kSize, "iasm,placement=column,extent=80");
  // At every depth the view's centre lies half-way between the sides of the tile that it is in.
  std::size_t inside = 0;
  for (const double depth : {1.0, 7.0, 18.0, 33.0})
    for (const PlanView& tile : r.plan) {
      const dvec4 clip =
          tile.shadowFromWorld * dvec4(view.eye + depth * glm::normalize(view.target - view.eye), 1);
      if (glm::any(glm::greaterThan(glm::abs(dvec2(clip)), dvec2(clip.w)))) continue;
      ++inside;
      EXPECT_NEAR(clip.y / clip.w, 0, 1e-3);
    }
  EXPECT_GE(inside, 4u);
}

TEST_F(FrameTiles, ListedSizesStayWithTheirTiles) {
  const auto scene = builtin("trees?count=40");
  const Rendering r = render(scene, viewOf(*scene, "walk"), lightOf(*scene, "sun"), kSize,
                             "iasm,resolution=listed,tile_sizes=8:16:32:64");
  for (std::uint32_t v = 0; v < 4; ++v) {
    EXPECT_EQ(r.plan[v].gpu.tile, v);
    EXPECT_EQ(r.plan[v].tile, glm::uvec2(v % 2, v / 2));
    EXPECT_EQ(r.plan[v].gpu.rectSize.x, 8u << v);
  }
}

TEST_F(FrameTiles, EqualTilesAgreeWithOneMapOfTheWhole) {
  // 4 tiles of 128 are a map of 256 over the same square: the same texels, so the same answers but on
  // borders.
  const auto scene = builtin("atrium");
  const View view = viewOf(*scene, "main");
  const Light light = lightOf(*scene, "sun");
  const Rendering tiles = render(scene, view, light, kSize, "iasm,tile_sizes=128:128:128:128");
  const Rendering whole = render(scene, view, light, kSize, "iasm,tile_sizes=256");
  std::size_t different = 0;
  for (std::size_t i = 0; i < tiles.pixels(); ++i) different += tiles.visibility(i) != whole.visibility(i);
  EXPECT_LE(different, tiles.pixels() / 2000);
}

TEST_F(FrameTiles, ALinearBufferHoldsWhatAnImageHolds) {
  const auto scene = builtin("atrium");
  for (const char* light : {"sun", "spot"})
    for (const char* method : {"sm,texels=256", "sdsm-log,texels=128", "csm,texels=200x100"}) {
      const View view = viewOf(*scene, "main");
      const Rendering image = render(scene, view, lightOf(*scene, light), kSize, method);
      const Rendering linear =
          render(scene, view, lightOf(*scene, light), kSize, fmt::format("{},storage=linear", method));
      EXPECT_EQ(linear.result.storeBytes, image.result.storeBytes);
      EXPECT_FALSE(image.plan[0].tile);
      std::size_t different = 0;
      for (std::size_t i = 0; i < image.pixels(); ++i)
        different += image.visibility(i) != linear.visibility(i);
      // Depths may differ in their last bit.
      EXPECT_LE(different, image.pixels() / 10'000) << method << " " << light;
    }
}

}  // namespace
}  // namespace sundial::test
