// Culling saves work and changes nothing that anyone sees.
#include <algorithm>

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

double work(const Rendering& r, std::string_view pass) { return r.work(pass, "primitives"); }

class FrameCull : public RendererTest {};

TEST_F(FrameCull, ChangesNoBytesOfAnyImage) {
  struct Case {
    const char *scene, *view, *light;
  };
  for (const Case& c :
       {Case{"atrium", "curtain", "sun"}, Case{"atrium", "main", "low"}, Case{"atrium", "main", "spot"},
        Case{"trees?count=60", "walk", "sun"}, Case{"trees?count=60", "canopy", "spot"}}) {
    SCOPED_TRACE(fmt::format("{} {} {}", c.scene, c.view, c.light));
    const auto scene = builtin(c.scene);
    // A wide kernel reads much of the map, not only the samples' texels.
    const auto job = [&](std::shared_ptr<const Scene> s) {
      return jobOf(std::move(s), viewOf(*scene, c.view), lightOf(*scene, c.light), {256, 256},
                   {"sm,texels=1024", "dv,texels=512", "dv,texels=512,lookup=pcf,kernel=15"}, kAllImages);
    };
    const auto culled = render(job(scene)), whole = render(job(withoutCulling(*scene)));
    for (std::size_t m = 0; m < culled.size(); ++m) {
      SCOPED_TRACE(culled[m].result.method.label());
      for (const Aov aov : kAllImages)
        EXPECT_TRUE(culled[m].images.at(aov).bytes == whole[m].images.at(aov).bytes) << aovName(aov);
      // The store of sm draws the scene; of dv and of the camera's view, only what reaches them.
      EXPECT_LT(work(culled[m], "gbuffer"), work(whole[m], "gbuffer"));
      EXPECT_LE(work(culled[m], "store"), work(whole[m], "store"));
    }
  }
}

TEST_F(FrameCull, ACloseUpDrawsASmallPartOfTheScene) {
  const auto scene = builtin("atrium");
  const auto triangles = static_cast<double>(scene->instancedTriangles());
  const View view{.eye = {1.6, 1.6, -0.4}, .target = {0.6, 0, -1.4}, .verticalFovDegrees = 30};
  const auto renderings =
      render(jobOf(scene, view, lightOf(*scene, "sun"), {128, 128}, {"sm,texels=256", "dv,texels=256"}));
  EXPECT_EQ(work(renderings[0], "store"), triangles) << "sm holds everything, once";
  EXPECT_LT(work(renderings[1], "store"), triangles / 4);
  EXPECT_LT(work(renderings[1], "gbuffer"), triangles / 10);
}

}  // namespace
}  // namespace sundial::test
