// Frames with a warp, and what holds for all of them.
#pragma once

#include <algorithm>
#include <cmath>

#include "bench/warped_samples.h"
#include "shadow/method_in_light.h"
#include "support/rendering.h"

namespace sundial::test {

using bench::Warped;

class FrameWarp : public RendererTest {
 protected:
  static Device& device() {
    static const auto device = [] {
      auto made = Device::create("", true, ShaderStages::all);
      if (!made) throw std::runtime_error(made.error().message);
      return std::move(*made);
    }();
    return *device;
  }
  static bench::FrameScene sight(const std::shared_ptr<const Scene>& scene, const View& view,
                                 const Light& light, const glm::uvec2& image) {
    static FramePipelines pipelines(device());
    return {device(), pipelines, {scene, view, light}, image};
  }
  // Of each map of the plan.
  static std::vector<Warped> warps(const std::shared_ptr<const Scene>& scene, const View& view,
                                   const Light& light, const glm::uvec2& image, std::string_view text,
                                   unsigned side = 1) {
    return bench::warpedOf(sight(scene, view, light, image), methodInLight(method(text), light.kind).value(),
                           side);
  }
  static Warped warp(const std::shared_ptr<const Scene>& scene, const View& view, const Light& light,
                     const glm::uvec2& image, std::string_view text) {
    return warps(scene, view, light, image, text).front();
  }
  void TearDown() override {
    EXPECT_EQ(device().validationMessages(), 0u);
    RendererTest::TearDown();
  }
};

// All functions rise from rim to rim, by at least `least` a texel, and the inverse is one. `kept`: texels at
// each side that stay where they are.
inline void expectWarp(const Warped& w, double least, unsigned kept = 0) {
  const auto expectRising = [&](const float* table, unsigned last) {
    EXPECT_EQ(table[0], 0);
    EXPECT_EQ(table[last], float(last));
    for (unsigned k = 0; k < last; ++k) ASSERT_GE(table[k + 1] - table[k], least) << k;
    for (unsigned k = 0; k <= kept; ++k) {
      EXPECT_EQ(table[k], float(k));
      EXPECT_EQ(table[last - k], float(last - k));
    }
  };
  for (std::size_t f = 0; f < w.rows; ++f) expectRising(w.across(f), w.size.x);
  for (std::size_t f = 0; f < w.columns; ++f) expectRising(w.down(f), w.size.y);
  double worst = 0;
  for (unsigned y = 0; y < w.size.y; ++y)
    for (unsigned x = 0; x < w.size.x; ++x) {
      const glm::dvec2 error = w(w.centre(x, y)) - glm::dvec2(x + 0.5, y + 0.5);
      worst = std::max({worst, std::abs(error.x), std::abs(error.y)});
    }
  EXPECT_LT(worst, 5e-3) << "texels";
}

}  // namespace sundial::test
