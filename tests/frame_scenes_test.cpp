// Real scenes under several lights: more texels bring more truth, and warps more of it to as many; the
// automatic bias leaves neither acne nor leaks, and ray tracing is the truth.
#include <algorithm>
#include <filesystem>

#include "support/rendering.h"

namespace sundial::test {
namespace {

struct NamedLightCase {
  std::string name;
  Light light;
};

// A spot from where the default view looks down, over the middle of the scene.
Light spotOver(const Scene& scene) {
  const Bounds& b = scene.bounds;
  const glm::dvec3 from(glm::mix(b.centre(), b.max, glm::dvec3(0.2, 1.2, 0.4)));
  return spot(from, b.centre(), 75);
}

std::vector<NamedLightCase> lightsOf(const Scene& scene) {
  std::vector<NamedLightCase> lights;
  if (scene.lights.empty())
    lights = {{"50 degrees", defaultLight(scene)}, {"spot", spotOver(scene)}};
  else
    lights = {{"sun", lightOf(scene, "sun")}, {"spot", lightOf(scene, "spot")}};
  lights.push_back({"5 degrees", sun(5, 20)});
  lights.push_back({"75 degrees", sun(75, 200)});
  return lights;
}

struct SceneCase {
  std::string name, scene;
  // The first named view; of a file, one that shows shadows in most of the picture.
  View view(const Scene& s) const {
    if (!s.views.empty()) return s.views.front().view;
    if (name == "apartment") return {.eye = {12, 7, 3}, .target = {6, 1, -6}, .verticalFovDegrees = 55};
    View view = defaultView(s);
    if (name == "space") view.verticalFovDegrees = 12;  // most of it is empty
    return view;
  }
  std::shared_ptr<const Scene> load() const {
    if (scene.ends_with(".glb")) {
      const auto files = readSceneFiles(std::filesystem::path(SUNDIAL_SCENES) / scene);
      if (!files) throw std::runtime_error(files.error().message);
      return sharedScene(parseGltf(*files));
    }
    return builtin(scene);
  }
};
void PrintTo(const SceneCase& c, std::ostream* out) { *out << c.scene; }

class FrameScenes : public RendererTest, public ::testing::WithParamInterface<SceneCase> {
 protected:
  void SetUp() override {
    RendererTest::SetUp();
    const std::string& file = GetParam().scene;
    if (file.ends_with(".glb") && !std::filesystem::exists(std::filesystem::path(SUNDIAL_SCENES) / file))
      GTEST_SKIP() << file << " is not in " << SUNDIAL_SCENES;
  }
};

TEST_P(FrameScenes, MoreTexelsAreTruerAndErrorsStayAtEdges) {
  const auto scene = GetParam().load();
  const View view = GetParam().view(*scene);
  for (const auto& [name, light] : lightsOf(*scene)) {
    SCOPED_TRACE(name);
    const auto renderings = render(jobOf(scene, view, light, {512, 512},
                                         {"sm,texels=512", "sm,texels=1024", "sm,texels=2048",
                                          "sm,texels=4096", "dv,texels=2048", "ray-traced"},
                                         {}, true));
    const auto measures = [&](std::size_t m) -> const Measures& { return *renderings[m].result.measures; };
    for (std::size_t m = 1; m < 4; ++m)
      EXPECT_GT(measures(m).pixelMatch, measures(m - 1).pixelMatch) << renderings[m].result.method.label();
    EXPECT_LE(measures(4).interiorError, 0.001);
    EXPECT_EQ(measures(5).pixelMatch, 1);
    EXPECT_EQ(measures(5).meanAbsError, 0);
  }
}

TEST_P(FrameScenes, WarpsHaveFewerWrongPixels) {
  const auto scene = GetParam().load();
  const auto renderings =
      render(jobOf(scene, scene->views.empty() ? defaultView(*scene) : scene->views.front().view,
                   lightsOf(*scene).front().light, {1024, 1024},
                   {"sm,texels=512", "rtw,texels=512", "notw,texels=512"}, {}, true));
  const auto match = [&](std::size_t m) { return renderings[m].result.measures->pixelMatch; };
  EXPECT_GT(match(1), match(0));
  EXPECT_GT(match(2), match(1));
}

INSTANTIATE_TEST_SUITE_P(All, FrameScenes,
                         ::testing::Values(SceneCase{"atrium", "atrium"},
                                           SceneCase{"trees", "trees?count=60"},
                                           SceneCase{"village", "village"},
                                           SceneCase{"apartment", "apartment.glb"},
                                           SceneCase{"jungle", "jungle.glb"}, SceneCase{"space", "space.glb"},
                                           SceneCase{"carriage", "carriage.glb"}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace sundial::test
