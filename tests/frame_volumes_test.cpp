// Shadow volumes say what shadow rays say: of polygon soups, from inside of shadows, through any number of
// layers.
#include <random>

#include "support/rendering.h"
#include "support/soups.h"

namespace sundial::test {
namespace {

class FrameVolumes : public RendererTest {
 protected:
  // Pixels of geometry whose visibility isn't the reference's, and how many of each kind there are.
  struct Agreement {
    std::size_t wrong = 0, lit = 0, dark = 0;
  };
  static Agreement agreement(const std::shared_ptr<const Scene>& scene, const View& view, const Light& light,
                             glm::uvec2 size = {320, 240}) {
    const Rendering r = render(scene, view, light, size, "shadow-volumes");
    Agreement a;
    for (std::size_t i = 0; i < r.pixels(); ++i) {
      if (!r.seen(i)) continue;
      a.wrong += r.visibility(i) != r.reference(i);
      ++(r.reference(i) > 0 ? a.lit : a.dark);
    }
    return a;
  }
};

const View kAbove{.eye = {3, 6, 8}, .target = {0, 0, 0}, .verticalFovDegrees = 50};

TEST_F(FrameVolumes, AgreeWithShadowRays) {
  for (const auto& [name, view, light] : {std::tuple("grid", "main", "sun"),
                                          {"grid", "low", "spot"},
                                          {"knot?along=40", "main", "sun"},
                                          {"knot?along=40", "close", "spot"},
                                          {"knot?along=40", "shadow", "low"},
                                          {"village", "lane", "low"},
                                          {"grid", "low", "lamp"},
                                          {"observatory", "main", "lamp"},
                                          {"observatory", "floor", "spot"}}) {
    SCOPED_TRACE(fmt::format("{} {} {}", name, view, light));
    const auto scene = builtin(name);
    const Agreement a = agreement(scene, viewOf(*scene, view), lightOf(*scene, light));
    EXPECT_LE(a.wrong, (a.lit + a.dark) / 10'000);
    EXPECT_GT(a.lit, 1000u);
    EXPECT_GT(a.dark, 1000u);
  }
}

// Triangles that share no corners, and sheets of which three share an edge.
TEST_F(FrameVolumes, PolygonSoupsCastTheirShadows) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> anywhere(-2, 2);
  Soup soup;
  for (int t = 0; t < 80; ++t) {
    const glm::vec3 a(anywhere(random), 2 + anywhere(random), anywhere(random));
    for (int corner = 0; corner < 3; ++corner)
      soup.positions.push_back(a + 0.3f * glm::vec3(anywhere(random), anywhere(random), anywhere(random)));
  }
  const glm::vec3 edge(0, 0, 3), foot(-3, 1, -1.5);
  for (const glm::vec3 fin : {glm::vec3(1, 1, 0), glm::vec3(-1, 1, 0.2), glm::vec3(0.2, 1.5, 0)})
    for (const glm::vec3 p : quad(foot, edge, fin).positions) soup.positions.push_back(p);
  Soups scene;
  const std::uint32_t mesh = scene.addMesh(soup);
  scene.addInstance(mesh);
  // A mirrored copy: its triangles run the other way around.
  glm::dmat4 mirrored(1);
  mirrored[0].x = -0.7;
  mirrored[3] = {5, 0, -3, 1};
  scene.addInstance(mesh, mirrored);
  scene.addInstance(scene.addMesh(quad({-8, 0, -8}, {0, 0, 16}, {16, 0, 0})));
  const auto finished = scene.finish();
  for (const Light& light : {sun(50, 30), sun(20, 200), spot({1, 7, 2}, {0, 0, 0}, 100), point({1, 7, 2}),
                             point({0.5, 2.1, -0.3})}) {
    const Agreement a = agreement(finished, kAbove, light);
    EXPECT_LE(a.wrong, (a.lit + a.dark) / 10'000);
    EXPECT_GT(a.dark, 1000u);
  }
}

// A stencil of 8 bits would come back to 0 under 256 sheets.
TEST_F(FrameVolumes, CountsDoNotOverflow) {
  for (const int sheets : {255, 256, 512}) {
    Soups scene;
    const std::uint32_t sheet = scene.addMesh(quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}));
    for (int i = 0; i < sheets; ++i) {
      glm::dmat4 place(1);
      place[3].y = 2 + 0.01 * i;
      scene.addInstance(sheet, place);
    }
    scene.addInstance(scene.addMesh(quad({-8, 0, -8}, {0, 0, 16}, {16, 0, 0})));
    const Agreement a = agreement(scene.finish(), kAbove, sun(60, 0), {160, 120});
    EXPECT_EQ(a.wrong, 0u) << sheets;
    EXPECT_GT(a.dark, 300u);
    EXPECT_GT(a.lit, 300u);
  }
}

TEST_F(FrameVolumes, ACameraInAShadowSeesTheSame) {
  Soups scene;
  scene.addInstance(scene.addMesh(quad({-3, 4, -3}, {0, 0, 6}, {6, 0, 0})));  // a roof, the eye below it
  scene.addInstance(scene.addMesh(quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0})));
  scene.addInstance(scene.addMesh(sphere(12)));
  const auto finished = scene.finish();
  const View below{.eye = {0, 2, 1}, .target = {0, 0, -2}, .verticalFovDegrees = 80};
  for (const Light& light : {sun(85, 10), spot({0, 9, 0}, {0, 0, 0}, 90), point({0, 9, 0})}) {
    const Agreement a = agreement(finished, below, light);
    EXPECT_EQ(a.wrong, 0u);
    EXPECT_GT(a.dark, 3000u);
    EXPECT_GT(a.lit, 300u);
  }
}

// Whatever lies above, behind or beside a light ends its rays: volumes that a camera which looks the same way
// is in at infinity.
TEST_F(FrameVolumes, ALampInAClosedRoomLightsItAndCastsShadows) {
  Soups scene;
  scene.addInstance(scene.addMesh(room(3)));
  const std::uint32_t ball = scene.addMesh(sphere(8));
  for (const glm::dvec3& at :
       {glm::dvec3(1.5, 0, 0.3), glm::dvec3(-1, 1.2, -1), glm::dvec3(0.1, -1.4, 1.1)}) {
    glm::dmat4 place(0.4);
    place[3] = glm::dvec4(at, 1);
    scene.addInstance(ball, place);
  }
  const auto finished = scene.finish();
  for (const glm::dvec3& eye :
       {glm::dvec3(2.5, 1, 2.5), glm::dvec3(-2.6, -2, 2.2), glm::dvec3(0.2, 2.7, -2.5)}) {
    const Agreement a = agreement(finished, {.eye = eye, .target = {0, 0, 0.1}, .verticalFovDegrees = 95},
                                  point({0.2, 0.1, -0.2}));
    EXPECT_LE(a.wrong, (a.lit + a.dark) / 10'000);
    EXPECT_GT(a.dark, 2000u);
    EXPECT_GT(a.lit, 30000u);
  }
}

// A list of silhouettes is bounded: what is more comes after it.
TEST_F(FrameVolumes, ManyEdgesAreDrawnInBatches) {
  Soups scene;
  const std::uint32_t ball = scene.addMesh(sphere(30));
  for (int i = 0; i < 225; ++i) {
    glm::dmat4 place(0.2);
    place[3] = {i % 15 - 7, 1, i / 15 - 7, 1};
    scene.addInstance(ball, place);
  }
  scene.addInstance(scene.addMesh(quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0})));
  const auto finished = scene.finish();
  ASSERT_GT(1.5 * static_cast<double>(finished->instancedTriangles()), 1 << 20);
  const Agreement a =
      agreement(finished, {.eye = {0, 14, 12}, .target = {0, 0, 0}, .verticalFovDegrees = 60}, sun(50, 30));
  EXPECT_LE(a.wrong, (a.lit + a.dark) / 10'000);
  EXPECT_GT(a.dark, 3000u);
}

TEST_F(FrameVolumes, RefuseWhatAlphaCuts) {
  const auto scene = builtin("trees?count=5");
  Collector collector;
  const auto done = renderer().run(
      jobOf(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {32, 32}, {"shadow-volumes"}), {},
      collector);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::invalidArgument);
  EXPECT_NE(done.error().message.find("twigs is alpha-tested"), std::string::npos) << done.error().message;
}

}  // namespace
}  // namespace sundial::test
