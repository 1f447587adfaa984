// Walks over the mesh, by which lookup=spsm decides what no stored triangle does: where they arrive, and what
// becomes of samples that light grazes.
#include <glm/gtc/matrix_transform.hpp>

#include "support/soups.h"
#include "support/wrong_pixels.h"

namespace sundial::test {
namespace {

using FrameWalk = WrongPixelsTest;

// The paper's figure: 5.6 times fewer wrong pixels than a plain map has. Packed or whole, it is the same
// walk.
TEST_F(FrameWalk, FindsOccludersThatNoTexelHolds) {
  auto w = wrong("knot", "main", "sun",
                 {"sm,texels=1024", "spsm,texels=1024", "spsm,texels=1024,storage=depth-id",
                  "spsm,texels=1024,kernel=5"});
  EXPECT_LT(5.6 * w["spsm,texels=1024"], w["sm,texels=1024"]);
  EXPECT_LT(5.6 * w["spsm,texels=1024,storage=depth-id"], w["sm,texels=1024"]);
  EXPECT_LT(w["spsm,texels=1024,kernel=5"], 0.9 * w["spsm,texels=1024"]);
}

// Balls over a floor, of which a texel holds one of many triangles: no walk over them meets a silhouette but
// their outline. In each kind of light, and where the instance is a mirror image.
TEST_F(FrameWalk, IsExactOverBalls) {
  const auto meshOf = [](const Soup& soup) {
    Primitive primitive{.positions = soup.positions, .uvs = {}, .colours = {}, .indices = {}, .material = 0};
    for (std::uint32_t i = 0; i < soup.positions.size(); ++i) primitive.indices.push_back(i);
    return std::vector{primitive};
  };
  SceneBuilder builder("balls");
  builder.addMaterial({.name = "grey", .gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}});
  builder.addInstance("floor", builder.addMesh("floor", meshOf(quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -12}))),
                      glm::dmat4(1));
  const std::uint32_t ball = builder.addMesh("ball", meshOf(sphere(48)));
  for (const double side : {-1.0, 1.0})
    builder.addInstance(
        "ball", ball,
        glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(1.5 * side, 2, 0)), glm::dvec3(side, 1, 1)));
  const auto scene = sharedScene(std::move(builder).finish());
  const View view{.eye = {0, 7, 7}, .target = {0, 0.5, 0}};
  const Light point{.kind = LightKind::point, .position = {0.3, 6, 0.5}};
  for (const Light& light : {sun(60, 20), spot({0.5, 9, 1}, {0, 0, 0}, 70), point}) {
    auto w = wrong(scene, view, light,
                   {"sm,texels=128", "spsm,texels=128", "spsm,texels=128,storage=depth-id",
                    "spsm,texels=128,recovery=edges"});
    EXPECT_GT(w["sm,texels=128"], 0.003);
    EXPECT_LT(w["spsm,texels=128"], 0.02 * w["sm,texels=128"]);
    EXPECT_LT(w["spsm,texels=128,storage=depth-id"], 0.02 * w["sm,texels=128"]);
    EXPECT_GT(w["spsm,texels=128,recovery=edges"], 2 * w["spsm,texels=128"]);
  }
}

// Leaves are cards with holes: light that falls through them does.
TEST_F(FrameWalk, RespectsHoles) {
  const auto scene = builtin("trees");
  const auto r = render(jobOf(scene, viewOf(*scene, "main"), lightOf(*scene, "sun"), {240, 180},
                              {"spsm,texels=1024", "spsm,texels=1024,recovery=edges"}, {}, true));
  EXPECT_LT(r[0].result.measures->falseShadow, 1e-4);
  EXPECT_GT(r[1].result.measures->falseShadow, 0.01);
}

// A plate under slats, which are all that the map holds: between them no walk arrives at it, and yet it is
// there.
TEST_F(FrameWalk, SecondLayersHideWhereNoLightIsNear) {
  SceneBuilder builder("slats");
  builder.addMaterial({.gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
  const auto quad = [&](float x0, float x1, float z0, float z1, float y) {
    const auto mesh = builder.addMesh(
        "quad",
        {{.positions = {{x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0}}, .indices = {0, 1, 2, 0, 2, 3}}});
    builder.addInstance("quad", mesh, glm::dmat4(1));
  };
  quad(-20, 20, -20, 20, 0);
  quad(-10, 10, -10, 10, 2);
  for (int slat = -12; slat < 12; ++slat) quad(float(slat), float(slat) + 0.9f, -10, 10, 4);
  const auto scene = sharedScene(std::move(builder).finish());
  const View below{.eye = {0, 1.5, 5}, .target = {0, 0, 0}, .verticalFovDegrees = 30};
  const auto r = render(jobOf(scene, below, sun(85, 30), {120, 120},
                              {"spsm,texels=64", "spsm,texels=64,storage=depth-id"}, {}, true));
  for (const Rendering& method : r) EXPECT_GT(method.result.measures->pixelMatch, 0.99);
}

// Two slopes that light grazes and that meet in a valley. A texel's depth is the nearest of all of its
// square, which on such a slope is far before the sample; yet nothing is.
TEST_F(FrameWalk, GrazedSlopesAreNotTheirOwnOccluders) {
  Soups soups;
  const float rise = 10 * std::tan(glm::radians(1.0f));
  soups.addInstance(soups.addMesh(quad({0, 0, -5}, {0, 0, 10}, {10, 0, 0})));
  soups.addInstance(soups.addMesh(quad({0, 0, -5}, {-10, rise, 0}, {0, 0, 10})));
  soups.addInstance(soups.addMesh(quad({-11, 0, -11}, {0, 12, 0}, {0, 0, 5})));  // makes the map high
  const View view{.eye = {3, 5, 5}, .target = {0, 0, 0}, .verticalFovDegrees = 40};
  auto w = wrong(soups.finish(), view, sun(2.3, 0), {"spsm,texels=256", "spsm,texels=256,storage=depth-id"});
  for (const auto& [method, share] : w) EXPECT_LT(share, 1e-4) << method;
}

// A wall on ground that light grazes: in the texels at its foot the ground before it is nearest. Light may
// leak as far as a map's bias goes.
TEST_F(FrameWalk, NoLightLeaksUnderAWallInLowLight) {
  Soups soups;
  soups.addInstance(soups.addMesh(quad({-10, 0, -10}, {0, 0, 20}, {20, 0, 0})));
  soups.addInstance(soups.addMesh(quad({0, 0, -3}, {0, 2, 0}, {0, 0, 6})));
  const View view{.eye = {-4, 5, 5}, .target = {-2, 0, 0}, .verticalFovDegrees = 40};
  auto w = wrong(soups.finish(), view, sun(1, 10), {"spsm,texels=256", "spsm,texels=256,storage=depth-id"});
  for (const auto& [method, share] : w) EXPECT_LT(share, 3e-3) << method;
}

// A view sample is rounded, and may lie below its plane, where a ray that all but lies in the plane would
// meet what adjoins it.
TEST_F(FrameWalk, GrazedSamplesLieOnTheirPlane) {
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.3, glm::normalize(glm::dvec3(3, 1, 2)));
  const auto turned = [&](const glm::dvec3& v) { return glm::dvec3(turn * glm::dvec4(v, 0)); };
  Soups soups;
  soups.addInstance(soups.addMesh(quad({-8, 0, -8}, {0, 0, 16}, {16, 0, 0})), turn);
  // Hangs from the ground's edge.
  soups.addInstance(soups.addMesh(quad({8, 0, -8}, {0, -2, 0}, {0, 0, 16})), turn);
  const View view{.eye = turned({-40, 30, 20}), .target = turned({7.8, 0, 0}), .verticalFovDegrees = 1};
  auto w = wrong(soups.finish(), view, Light{.direction = turned({-1, -5e-6, 0})},
                 {"spsm,texels=256", "spsm,texels=256,storage=depth-id"});
  for (const auto& [method, share] : w) EXPECT_LT(share, 1e-4) << method;
}

}  // namespace
}  // namespace sundial::test
