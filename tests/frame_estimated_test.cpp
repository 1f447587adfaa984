// resolution=estimated: texels as small as the pixels that ask for them, where that is known in closed form,
// in memory that shrinks with them.
#include <algorithm>
#include <cmath>

#include "support/rendering.h"

namespace sundial::test {
namespace {

using glm::dvec2;
using glm::dvec3;

class FrameEstimated : public RendererTest {};

// A ground that fills every view that looks down on it.
std::shared_ptr<const Scene> plane() {
  SceneBuilder builder("plane");
  builder.addMaterial({.gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}});
  const std::uint32_t mesh = builder.addMesh(
      "ground", {{.positions = {{-1000, 0, -1000}, {-1000, 0, 1000}, {1000, 0, 1000}, {1000, 0, -1000}},
                  .indices = {0, 1, 2, 0, 2, 3}}});
  builder.addInstance("ground", mesh, glm::dmat4(1));
  return sharedScene(std::move(builder).finish());
}

// Where the ray through a point of the image meets the ground; pixels from the top left corner.
dvec3 onGround(const View& view, const glm::uvec2& size, double x, double y) {
  const dvec3 forward = glm::normalize(view.target - view.eye);
  const dvec3 right = glm::normalize(glm::cross(forward, view.up)), up = glm::cross(right, forward);
  const double tanY = std::tan(glm::radians(view.verticalFovDegrees) / 2), tanX = tanY * size.x / size.y;
  const dvec3 ray = forward + (2 * x / size.x - 1) * tanX * right + (1 - 2 * y / size.y) * tanY * up;
  return view.eye - view.eye.y / ray.y * ray;
}

// What each pixel spans in a map of this plan, in NDC, sorted; and all of their centres together.
struct Spans {
  std::vector<double> width, height;
  dvec2 low{1e9}, high{-1e9};
  dvec2 texels(double percentile) const {
    const auto at = static_cast<std::size_t>(percentile / 100 * static_cast<double>(width.size()));
    return (high - low) / dvec2(width[at], height[at]);
  }
};
Spans spansOf(const PlanView& plan, const View& view, const glm::uvec2& size) {
  const auto project = [&](double x, double y) {
    const glm::dvec4 clip = plan.shadowFromWorld * glm::dvec4(onGround(view, size, x, y), 1);
    return dvec2(clip) / clip.w;
  };
  Spans spans;
  for (unsigned y = 0; y < size.y; ++y)
    for (unsigned x = 0; x < size.x; ++x) {
      dvec2 low(1e9), high(-1e9);
      for (int corner = 0; corner < 4; ++corner) {
        const dvec2 p = project(x + corner % 2, y + (corner >> 1));
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
      spans.width.push_back(high.x - low.x);
      spans.height.push_back(high.y - low.y);
      const dvec2 centre = project(x + 0.5, y + 0.5);
      spans.low = glm::min(spans.low, centre);
      spans.high = glm::max(spans.high, centre);
    }
  std::ranges::sort(spans.width);
  std::ranges::sort(spans.height);
  return spans;
}

TEST_F(FrameEstimated, APlaneGetsWhatItsSmallestPixelAsksFor) {
  const auto ground = plane();
  const View oblique{.eye = {3, 12, 5}, .target = {6, 0, -4}, .verticalFovDegrees = 40};
  for (const Light& light : {sun(35, 20), sun(70, 200), spot({-8, 30, 3}, {5, 0, -3}, 100)})
    for (const double percentile : {0.0, 2.0, 25.0}) {
      const glm::uvec2 size{300, 200};
      const Rendering r =
          render(ground, oblique, light, size, fmt::format("ferko,percentile={}", percentile));
      SCOPED_TRACE(fmt::format("{} {}", r.result.method.label(), int(light.kind)));
      ASSERT_EQ(r.plan.front().gpu.sampleCount, size.x * size.y);
      const dvec2 wanted = spansOf(r.plan.front(), oblique, size).texels(percentile) + 2.0;
      const dvec2 chosen(r.plan.front().gpu.rectSize);
      EXPECT_NEAR(chosen.x, wanted.x, 0.01 * wanted.x);
      EXPECT_NEAR(chosen.y, wanted.y, 0.01 * wanted.y);
    }
}

TEST_F(FrameEstimated, ALightWhereTheCameraIsGetsTheImagesResolution) {
  const auto atrium = builtin("atrium");
  const View view = viewOf(*atrium, "main");
  for (const glm::uvec2 size : {glm::uvec2{400, 300}, {256, 512}}) {
    const Rendering r = render(atrium, view, spot(view.eye, view.target, 120), size, "ferko");
    EXPECT_NEAR(r.plan.front().gpu.rectSize.x, size.x, 0.01 * size.x);
    EXPECT_NEAR(r.plan.front().gpu.rectSize.y, size.y, 0.01 * size.y);
  }
}

TEST_F(FrameEstimated, TheCapHoldsAndUnderItMemoryShrinks) {
  const auto ground = plane();
  const View view{.eye = {3, 12, 5}, .target = {6, 0, -4}, .verticalFovDegrees = 40};
  const auto of = [&](std::string_view method) {
    return render(ground, view, sun(35, 20), {150, 100}, method);
  };
  const Rendering capped = of("ferko,texels=64x1024");
  EXPECT_EQ(capped.plan.front().gpu.rectSize.x, 64u);
  EXPECT_LT(capped.plan.front().gpu.rectSize.y, 1024u);

  const Rendering gpu = of("ferko,texels=1024"), readback = of("ferko,texels=1024,plan=readback");
  const glm::uvec2 used = gpu.plan.front().gpu.rectSize;
  EXPECT_LT(used.x * used.y, 512u * 1024);
  EXPECT_EQ(gpu.result.storeBytes, 4u * used.x * used.y);
  EXPECT_EQ(gpu.result.allocatedBytes, 4u * 1024 * 1024);
  EXPECT_EQ(readback.result.storeBytes, gpu.result.storeBytes);
  EXPECT_EQ(readback.result.allocatedBytes, readback.result.storeBytes);
}

// Than a texel of the fixed map, or half of one: the larger of that and of what the pixels ask for.
TEST_F(FrameEstimated, NothingIsFinerThanItMayBe) {
  const auto atrium = builtin("atrium"), observatory = builtin("observatory");
  for (const auto& [scene, light] : {std::pair(atrium, "sun"), {atrium, "spot"}, {observatory, "lamp"}}) {
    const auto of = [&](std::string_view method) {
      return render(scene, viewOf(*scene, "main"), lightOf(*scene, light), {400, 300}, method);
    };
    const Rendering fixed = of("sm,texels=512"), free = of("ferko,texels=512");
    for (const double finest : {1.0, 0.5}) {
      const Rendering r = of(fmt::format("ferko,texels=512,finest={}", finest));
      for (std::size_t v = 0; v < r.plan.size(); ++v) {
        const shared::ShadowView& view = r.plan[v].gpu;
        if (view.sampleCount == 0) continue;
        SCOPED_TRACE(fmt::format("{} {} view {}", light, finest, v));
        for (const int axis : {0, 1}) {
          const double wanted =
              std::max(finest * fixed.plan[v].gpu.texelSize[axis], double(free.plan[v].gpu.texelSize[axis]));
          EXPECT_GT(view.texelSize[axis], 0.99 * wanted);
          EXPECT_LT(view.texelSize[axis], 1.1 * wanted);  // whole texels, of which there are few
        }
      }
    }
  }
}

// Rectangles of an image, or ranges of a buffer, that nothing else has.
void expectApart(const Rendering& r, bool linear) {
  for (const PlanView& a : r.plan)
    for (const PlanView& b : r.plan) {
      if (&a == &b) continue;
      const auto endA = a.gpu.rectOffset + a.gpu.rectSize, endB = b.gpu.rectOffset + b.gpu.rectSize;
      const auto areaA = a.gpu.rectSize.x * a.gpu.rectSize.y;
      EXPECT_TRUE(linear ? a.gpu.linearOffset + areaA <= b.gpu.linearOffset ||
                               b.gpu.linearOffset < a.gpu.linearOffset
                         : glm::any(glm::lessThanEqual(endA, b.gpu.rectOffset)) ||
                               glm::any(glm::lessThanEqual(endB, a.gpu.rectOffset)));
    }
}

TEST_F(FrameEstimated, EveryPartitionAndTileGetsItsOwnWhoeverKnowsThePlan) {
  const auto atrium = builtin("atrium");
  for (const char* light : {"sun", "spot"})
    for (const auto& [fixed, text] :
         {std::pair("sdsm-log,texels=512", "sdsm-log,texels=512,resolution=estimated,percentile=2"),
          {"sdsm-log,texels=512", "sdsm-log,texels=512,resolution=estimated,percentile=2,storage=linear"},
          {"pssm,texels=512", "pssm,texels=512,resolution=estimated,percentile=2"},
          {"sdsm-snapped,texels=512", "sdsm-snapped,texels=512,resolution=estimated,percentile=2"},
          {"sm,texels=2048", "sm,resolution=estimated,percentile=10"},
          {"iasm", "iasm,resolution=estimated,percentile=2"},
          {"iasm,focus=aabb", "iasm,focus=aabb,resolution=estimated,percentile=2"}}) {
      SCOPED_TRACE(fmt::format("{} {}", text, light));
      const auto of = [&](std::string_view method) {
        return render(atrium, viewOf(*atrium, "main"), lightOf(*atrium, light), {200, 150}, method);
      };
      const Rendering full = of(fixed), gpu = of(text), readback = of(fmt::format("{},plan=readback", text));
      expectApart(gpu, gpu.work("store", "by_compute") > 0);
      EXPECT_LT(gpu.result.storeBytes, full.result.storeBytes);
      EXPECT_EQ(readback.images.at(Aov::visibility).bytes, gpu.images.at(Aov::visibility).bytes);
      EXPECT_LE(readback.result.allocatedBytes, gpu.result.allocatedBytes);
      EXPECT_GE(gpu.result.measures->pixelMatch, full.result.measures->pixelMatch - 0.015);
      bool differ = false;
      for (const PlanView& view : gpu.plan) differ |= view.gpu.rectSize != gpu.plan[0].gpu.rectSize;
      EXPECT_EQ(differ, gpu.plan.size() > 1);
    }
}

TEST_F(FrameEstimated, TilesThatAskForMoreThanTheBufferShareIt) {
  const auto atrium = builtin("atrium");
  const Rendering r =
      render(atrium, viewOf(*atrium, "main"), lightOf(*atrium, "sun"), {400, 300},
             "iasm,resolution=estimated,tile_sizes=128:128:64:64:32:32:32:32:16:16:16:16:16:16:16:16");
  EXPECT_LE(r.result.storeBytes, r.result.allocatedBytes);
  EXPECT_GE(r.result.storeBytes, r.result.allocatedBytes / 2);
  for (const PlanView& view : r.plan) EXPECT_LE(std::max(view.gpu.rectSize.x, view.gpu.rectSize.y), 128u);
}

TEST_F(FrameEstimated, NothingInViewAsksForNothing) {
  const auto scene = builtin("grid");
  View sky = viewOf(*scene, "main");
  sky.target = sky.eye + dvec3(0.2, 1, 0);
  for (const char* method : {"ferko", "ferko,percentile=1,plan=readback", "sdsm-log,resolution=estimated",
                             "iasm,resolution=estimated", "iasm,resolution=estimated,plan=readback"}) {
    const Rendering r = render(scene, sky, lightOf(*scene, "sun"), {64, 64}, method);
    EXPECT_EQ(r.result.measures->pixelMatch, 1) << method;
    EXPECT_LT(r.result.storeBytes, 100'000u) << method;
  }
}

}  // namespace
}  // namespace sundial::test
