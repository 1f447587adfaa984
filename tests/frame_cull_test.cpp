// Culling saves work and changes nothing that anyone sees.
#include <array>

#include "shadow/camera.h"
#include "shadow/frame_runner.h"
#include "support/rendering.h"

namespace sundial::test {
namespace {

// The same scene, its clusters so large that they reach every view.
std::shared_ptr<const Scene> withoutCulling(const Scene& scene) {
  Scene copy = scene;
  for (shared::Cluster& cluster : copy.clusters) {
    cluster.boundsMin = glm::vec3(-1e6f);
    cluster.boundsMax = glm::vec3(1e6f);
  }
  return std::make_shared<const Scene>(std::move(copy));
}

// What one frame left in its target, and the triangles that its passes drew.
struct Drawn {
  std::array<std::vector<std::byte>, 4> images;  // depth, ids, positions, visibility
  double gbuffer = 0, store = 0;
};

class FrameCull : public RendererTest {
 protected:
  // `drawn` is what is drawn, as `scene` would be: the light's box is that of `scene`.
  static Drawn draw(const Device& device, const std::shared_ptr<const Scene>& scene,
                    const std::shared_ptr<const Scene>& drawn, const View& view, const Light& light,
                    std::string_view text) {
    FramePipelines pipelines(device);
    const ViewTarget target(device, {256, 256});
    SceneBuffers buffers(device, drawn);
    const glm::dvec3 origin = frameOrigin(*scene, view);
    buffers.moveTo(device, origin);
    Frame frame({.device = device,
                 .pipelines = pipelines,
                 .scene = buffers,
                 .target = target,
                 .reference = nullptr,
                 .light = light,
                 .origin = origin,
                 .constants = frameConstants(*scene, view, light, target.size(), origin)},
                method(text));
    const auto passes = frame.passes();
    const auto timing = runFrame(device, passes, {});
    if (!timing) throw std::runtime_error(timing.error().message);
    Drawn out{.images = {downloaded(device, target.depth, 4), downloaded(device, target.ids, 8),
                         downloaded(device, target.positions, 16), downloaded(device, target.visibility, 4)}};
    for (std::size_t pass = 0; pass < passes.size(); ++pass)
      for (const Work& work : timing->work[pass]) {
        if (work.name != "primitives") continue;
        if (passes[pass].name == "gbuffer") out.gbuffer = work.count;
        if (passes[pass].name == "store") out.store = work.count;
      }
    return out;
  }
};

TEST_F(FrameCull, ChangesNoBytesOfAnyImage) {
  const auto device = Device::create("", true);
  ASSERT_TRUE(device) << device.error().message;
  struct Case {
    const char *scene, *view, *light;
  };
  for (const Case& c :
       {Case{"atrium", "curtain", "sun"}, Case{"atrium", "main", "low"}, Case{"atrium", "main", "spot"},
        Case{"trees?count=60", "walk", "sun"}, Case{"trees?count=60", "canopy", "spot"}}) {
    const auto scene = builtin(c.scene);
    // A wide kernel reads much of the map, not only the samples' texels.
    for (const char* text : {"sm,texels=1024", "dv,texels=512", "dv,texels=512,lookup=pcf,kernel=15"}) {
      SCOPED_TRACE(fmt::format("{} {} {} {}", c.scene, c.view, c.light, text));
      const auto drawIt = [&](const std::shared_ptr<const Scene>& drawn) {
        return draw(**device, scene, drawn, viewOf(*scene, c.view), lightOf(*scene, c.light), text);
      };
      const Drawn culled = drawIt(scene), whole = drawIt(withoutCulling(*scene));
      for (std::size_t i = 0; i < culled.images.size(); ++i)
        EXPECT_TRUE(culled.images[i] == whole.images[i]) << i;
      // The store of sm draws the scene; of dv and of the camera's view, only what reaches them.
      EXPECT_LT(culled.gbuffer, whole.gbuffer);
      EXPECT_LE(culled.store, whole.store);
    }
  }
  EXPECT_EQ((*device)->validationMessages(), 0u);
}

TEST_F(FrameCull, ACloseUpDrawsASmallPartOfTheScene) {
  const auto scene = builtin("atrium");
  const auto triangles = static_cast<double>(scene->instancedTriangles());
  const View view{.eye = {1.6, 1.6, -0.4}, .target = {0.6, 0, -1.4}, .verticalFovDegrees = 30};
  const auto renderings =
      render(jobOf(scene, view, lightOf(*scene, "sun"), {128, 128}, {"sm,texels=256", "dv,texels=256"}));
  EXPECT_EQ(renderings[0].work("store", "primitives"), triangles) << "sm holds everything, once";
  EXPECT_LT(renderings[1].work("store", "primitives"), triangles / 4);
  EXPECT_LT(renderings[1].work("gbuffer", "primitives"), triangles / 10);
}

TEST_F(FrameCull, WithoutItEveryViewDrawsEverythingAndNothingChanges) {
  const auto scene = builtin("trees?count=40");
  for (const char* text : {"csm,texels=256", "csm,texels=256,plan=readback"}) {
    SCOPED_TRACE(text);
    const auto renderings = render(jobOf(scene, viewOf(*scene, "walk"), lightOf(*scene, "sun"), {128, 128},
                                         {text, fmt::format("{},cull=none", text)}, {Aov::visibility}));
    EXPECT_LT(renderings[0].work("store", "scenes"), 2);
    EXPECT_EQ(renderings[1].work("store", "scenes"), 3);
    EXPECT_TRUE(renderings[0].images.at(Aov::visibility).bytes ==
                renderings[1].images.at(Aov::visibility).bytes);
  }
}

// Alecu's worst case: the one mesh reaches every map and every view, most of its clusters don't.
TEST_F(FrameCull, OneMeshThatSpansEverythingIsCulledByItsClusters) {
  const auto scene = builtin("village");
  ASSERT_EQ(scene->instances.size(), 1u);
  const auto triangles = static_cast<double>(scene->instancedTriangles());
  const auto renderings =
      render(jobOf(scene, viewOf(*scene, "fence"), lightOf(*scene, "noon"), {128, 128}, {"dv,texels=256"}));
  EXPECT_LT(renderings[0].work("gbuffer", "primitives"), triangles / 5);
  EXPECT_LT(renderings[0].work("store", "primitives"), triangles / 10);
}

}  // namespace
}  // namespace sundial::test
