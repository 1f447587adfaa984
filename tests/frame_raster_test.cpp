// Maps drawn by compute are the pipeline's maps, and what is asked of them gets the same answers.
#include <array>

#include "shadow/camera.h"
#include "shadow/frame_runner.h"
#include "support/device_test.h"
#include "support/rendering.h"

namespace sundial::test {
namespace {

// Of one frame: the depths of each view, row by row.
std::vector<std::vector<float>> mapsOf(const Device& device, FramePipelines& pipelines,
                                       const std::shared_ptr<const Scene>& scene, const View& view,
                                       Light light, std::string_view text) {
  const ViewTarget target(device, {200, 150});
  SceneBuffers buffers(device, scene);
  const glm::dvec3 origin = frameOrigin(*scene, view);
  buffers.moveTo(device, origin);
  light.direction = glm::normalize(light.direction);
  Frame frame({.device = device,
               .pipelines = pipelines,
               .scene = buffers,
               .target = target,
               .reference = nullptr,
               .edges = nullptr,
               .light = light,
               .origin = origin,
               .constants = frameConstants(*scene, view, light, target.size(), origin)},
              method(text));
  if (const auto run = runFrame(device, frame.passes(), {}); !run)
    throw std::runtime_error(run.error().message);
  const std::vector<float> depths = frame.downloadDepths();
  const shared::Plan plan = frame.downloadPlan();
  const bool linear = text.find("raster=compute") != std::string_view::npos;
  std::uint32_t width = 0;
  for (const shared::ShadowView& v : std::span(plan.views, plan.viewCount))
    width = std::max(width, v.rectOffset.x + v.rectSize.x);
  std::vector<std::vector<float>> maps;
  for (const shared::ShadowView& v : std::span(plan.views, plan.viewCount)) {
    std::vector<float>& map = maps.emplace_back();
    for (std::uint32_t y = 0; y < v.rectSize.y; ++y)
      for (std::uint32_t x = 0; x < v.rectSize.x; ++x)
        map.push_back(linear ? depths[v.linearOffset + y * v.rectSize.x + x]
                             : depths[(v.rectOffset.y + y) * width + v.rectOffset.x + x]);
  }
  return maps;
}

class FrameRaster : public RendererTest {};

struct Case {
  const char *scene, *view, *light;
};
class CoverageOfThePipeline : public DeviceTest<::testing::TestWithParam<Case>> {
 protected:
  static FramePipelines& pipelines() {
    static FramePipelines instance(device());
    return instance;
  }
};

TEST_P(CoverageOfThePipeline, TexelForTexel) {
  const Case& c = GetParam();
  const auto scene = builtin(c.scene);
  // Sizes that aren't powers of two round where the pipeline rounds, too.
  for (const char* text : {"sm,texels=1000", "csm,texels=160x100", "sdsm-log,texels=256"}) {
    SCOPED_TRACE(text);
    const auto draw = [&](const char* raster) {
      return mapsOf(device(), pipelines(), scene, viewOf(*scene, c.view), lightOf(*scene, c.light),
                    fmt::format("{},raster={}", text, raster));
    };
    const auto pipeline = draw("pipeline"), compute = draw("compute");
    std::size_t texels = 0, covered = 0, differently = 0, far = 0;
    ASSERT_EQ(pipeline.size(), compute.size());
    for (std::size_t v = 0; v < pipeline.size(); ++v)
      for (std::size_t i = 0; i < pipeline[v].size(); ++i) {
        ++texels;
        covered += pipeline[v][i] > 0;
        differently += (pipeline[v][i] > 0) != (compute[v][i] > 0);
        far += std::abs(pipeline[v][i] - compute[v][i]) > 1e-4f;
      }
    EXPECT_GT(covered, texels / 8);
    EXPECT_EQ(differently, 0u);
    EXPECT_EQ(far, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CoverageOfThePipeline,
                         ::testing::Values(Case{"atrium", "main", "sun"}, Case{"atrium", "curtain", "spot"},
                                           Case{"trees?count=60", "walk", "sun"},
                                           Case{"trees?count=60", "canopy", "spot"},
                                           Case{"village", "fence", "noon"}, Case{"grid", "low", "low"}),
                         [](const auto& info) { return fmt::format("{}", info.index); });

TEST_F(FrameRaster, AHostsPlanDrawsTheSameMaps) {
  const auto scene = builtin("trees?count=40");
  for (const char* text : {"sdsm-log,texels=200,raster=compute", "iasm"}) {
    const View view = viewOf(*scene, "walk");
    const Light light = lightOf(*scene, "sun");
    const Rendering device = render(scene, view, light, {160, 120}, text);
    const Rendering host = render(scene, view, light, {160, 120}, fmt::format("{},plan=readback", text));
    EXPECT_TRUE(device.images.at(Aov::visibility).bytes == host.images.at(Aov::visibility).bytes) << text;
    EXPECT_EQ(device.work("store", "primitives"), host.work("store", "primitives")) << text;
  }
}

TEST_F(FrameRaster, TheStorePassSaysWhoDrew) {
  const auto scene = builtin("atrium");
  const auto renderings = render(jobOf(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {64, 64},
                                       {"sm,texels=64,raster=pipeline", "sm,texels=64,raster=compute",
                                        "sm,texels=64", "sdsm-log,texels=2048", "iasm", "evsm,texels=64"}));
  const bool cpu = renderer().device().name.find("llvmpipe") != std::string::npos;
  const std::array expected{0.0, 1.0, cpu ? 1.0 : 0.0, 0.0, 1.0, 0.0};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(renderings[i].work("store", "by_compute"), expected[i]) << i;
  // Either way the triangles are counted.
  EXPECT_EQ(renderings[0].work("store", "primitives"), renderings[1].work("store", "primitives"));
}

TEST_F(FrameRaster, ExactHitsLeaveFewWrongPixels) {
  struct Share {
    const char *scene, *view, *light;
    double most;
  };
  for (const Share& c : {Share{"grid", "low", "low", 0.35}, Share{"atrium", "main", "sun", 0.8}}) {
    const auto scene = builtin(c.scene);
    const auto both = render(jobOf(scene, viewOf(*scene, c.view), lightOf(*scene, c.light), {400, 300},
                                   {"sm,texels=1024", "id,texels=1024"}, {}, true));
    const double plain = 1 - both[0].result.measures->pixelMatch,
                 exact = 1 - both[1].result.measures->pixelMatch;
    EXPECT_GT(plain, 0.001) << c.scene;
    EXPECT_LE(exact, c.most * plain) << c.scene;
  }
}

TEST_F(FrameRaster, ExactHitsSeeHolesInLeaves) {
  const auto scene = builtin("trees?count=40");
  const auto both = render(jobOf(scene, viewOf(*scene, "walk"), lightOf(*scene, "sun"), {300, 200},
                                 {"sdsm-log,texels=1024", "sdsm-log-id,texels=1024"}, {}, true));
  EXPECT_LT(both[1].result.measures->falseShadow, 0.5 * both[0].result.measures->falseShadow);
}

TEST_F(FrameRaster, WhatCantBeIsRefusedWithTheReason) {
  const auto pipeline = parseMethod("iasm,raster=pipeline");
  ASSERT_FALSE(pipeline);
  EXPECT_NE(pipeline.error().message.find("raster=compute"), std::string::npos) << pipeline.error().message;
  const auto plain = parseMethod("sm,lookup=exact-3x3");
  ASSERT_FALSE(plain);
  EXPECT_NE(plain.error().message.find("storage=depth-id"), std::string::npos) << plain.error().message;
  const auto scene = builtin("grid");
  Collector collector;
  for (const char* large : {"sm,texels=8192,raster=compute", "id,texels=8192"}) {
    const auto refused = renderer().run(
        jobOf(scene, viewOf(*scene, "low"), lightOf(*scene, "low"), {16, 16}, {large}), {}, collector);
    ASSERT_FALSE(refused) << large;
    EXPECT_NE(refused.error().message.find("bytes of one buffer"), std::string::npos)
        << refused.error().message;
  }
}

}  // namespace
}  // namespace sundial::test
