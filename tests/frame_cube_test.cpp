// partition=cube: six faces about a point light see what a ray to it does, also where they meet.
#include <algorithm>
#include <set>

#include "shared/cube.h"
#include "support/rendering.h"
#include "support/soups.h"

namespace sundial::test {
namespace {

using glm::dvec3;

TEST(Cube, AFaceIsARotationThatLooksAlongItsAxis) {
  for (std::uint32_t face = 0; face < shared::kCubeFaces; ++face) {
    SCOPED_TRACE(face);
    glm::mat4 images;
    for (int i = 0; i < 4; ++i) {
      glm::vec4 unit(0);
      unit[i] = 1;
      images[i] = shared::faceFromLight(face, unit);
    }
    EXPECT_EQ(glm::transpose(images) * images, glm::mat4(1));
    EXPECT_EQ(glm::determinant(images), 1);
    EXPECT_EQ(images[2], glm::vec4(0, 0, 1, 0)) << "the reciprocal of distance stays what it is";
    for (int i = 0; i < 4; ++i)
      EXPECT_EQ(shared::lightFromFace(face, images[i]), glm::mat4(1)[i]) << "and back";
    const glm::vec4 axis = glm::transpose(images) * glm::vec4(0, 0, 0, 1);
    EXPECT_EQ(shared::faceOf(axis), face);
  }
}

TEST(Cube, APointLiesInThePyramidOfItsFace) {
  std::array<int, shared::kCubeFaces> found{};
  for (int i = 0; i < 9 * 9 * 9; ++i) {
    const glm::vec4 p(i % 9 - 4, i / 9 % 9 - 4, 1, i / 81 - 4);
    if (p.x == 0 && p.y == 0 && p.w == 0) continue;
    const std::uint32_t face = shared::faceOf(p);
    const glm::vec4 inFace = shared::faceFromLight(face, p);
    EXPECT_GE(inFace.w, std::abs(inFace.x));
    EXPECT_GE(inFace.w, std::abs(inFace.y));
    ++found.at(face);
  }
  EXPECT_GT(std::ranges::min(found), 80);
}

TEST(Cube, ATurnedFaceMeasuresAlongItsAxis) {
  const glm::vec2 axis(0.6f, 0.8f);
  const glm::vec4 turned = shared::turnedFace({2.0f * axis, 3, 4}, axis);
  EXPECT_NEAR(turned.x, 2, 1e-6);
  EXPECT_NEAR(turned.y, 0, 1e-6);
  EXPECT_EQ(glm::vec2(turned.z, turned.w), glm::vec2(3, 4));
}

class FrameCube : public RendererTest {};

// Walls that a light in their midst falls on along all edges and corners of the cube about it.
std::shared_ptr<const Scene> emptyRoom() {
  Soups scene;
  scene.addInstance(scene.addMesh(room(4)));
  return scene.finish();
}

// A cage of bars about the light, whose shadows cross the cube's edges.
std::shared_ptr<const Scene> cage() {
  Soups scene;
  scene.addInstance(scene.addMesh(room(4)));
  Soup bars;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = -3; i <= 3; ++i)
      for (const float side : {-1.0f, 1.0f}) {
        glm::vec3 corner(-1.2f), along(0), across(0);
        corner[axis] = -1.2f;
        along[axis] = 2.4f;
        corner[(axis + 1) % 3] = 0.35f * static_cast<float>(i);
        across[(axis + 1) % 3] = 0.08f;
        corner[(axis + 2) % 3] = 1.2f * side;
        for (const glm::vec3 p : quad(corner, along, across).positions) bars.positions.push_back(p);
      }
  scene.addInstance(scene.addMesh(bars));
  return scene.finish();
}

const dvec3 kLamp(0.2, -0.1, 0.15);

std::vector<View> viewsAbout() {
  std::vector<View> views;
  for (const dvec3& towards : {dvec3(1, 1, 1), dvec3(-1, 1, 1), dvec3(1, -1, -1), dvec3(-1, -1, -1)})
    views.push_back({.eye = -3.0 * towards, .target = towards, .verticalFovDegrees = 100});
  return views;
}

TEST_F(FrameCube, ALampInAnEmptyRoomCastsNoShadow) {
  const auto scene = emptyRoom();
  for (const View& view : viewsAbout())
    for (const Rendering& r :
         render(jobOf(scene, view, point(kLamp), {160, 120},
                      {"sm,texels=64", "sm,texels=64,raster=compute", "dv,texels=64", "id,texels=64",
                       "ferko,texels=256", "msf,texels=64", "spsm,texels=64", "rgsm,texels=64",
                       "rtw,texels=64", "rtw,texels=64,analysis=forward", "notw,texels=64"},
                      kAllImages))) {
      SCOPED_TRACE(r.result.method.label());
      std::size_t dark = 0, unanswered = 0;
      for (std::size_t i = 0; i < r.pixels(); ++i) {
        dark += r.visibility(i) < 1 - 1e-5;
        unanswered += !r.answered(i);
      }
      EXPECT_EQ(dark, 0u);
      EXPECT_EQ(unanswered, 0u);
      ASSERT_EQ(r.plan.size(), shared::kCubeFaces);
    }
}

// In a room's corners a filter meets the next wall; here the cube's edges lie in the middle of a floor.
TEST_F(FrameCube, FiltersAreWholeAtTheCubesEdges) {
  Soups scene;
  scene.addInstance(scene.addMesh(quad({-9, -1, -9}, {0, 0, 18}, {18, 0, 0})));
  const auto floor = scene.finish();
  const View view{.eye = {3, 4, 6}, .target = {0, -1, 0}, .verticalFovDegrees = 70};
  for (const Rendering& r :
       render(jobOf(floor, view, point(kLamp), {160, 120},
                    {"sm,texels=64,lookup=pcf,kernel=7", "dv,texels=64,lookup=pcf,kernel=2",
                     "sm,texels=16,lookup=pcf,kernel=15", "rtw,texels=64,lookup=pcf,kernel=7",
                     "notw,texels=64,lookup=pcf,kernel=7"},
                    kAllImages))) {
    std::size_t dark = 0;
    std::set<std::uint32_t> faces;
    for (std::size_t i = 0; i < r.pixels(); ++i) {
      if (!r.seen(i)) continue;
      dark += r.visibility(i) < 1 - 1e-5;
      faces.insert(r.at<std::uint32_t>(Aov::view, i));
    }
    EXPECT_EQ(dark, 0u) << r.result.method.label();
    EXPECT_EQ(faces.size(), 5u);
  }
}

// How many texels of its own face a pixel is away from the face's end.
double texelsToSeam(const Rendering& r, std::size_t pixel, double texels) {
  dvec3 from = glm::abs(r.position(pixel) - kLamp);
  std::array<double, 3> sorted{from.x, from.y, from.z};
  std::ranges::sort(sorted);
  return 0.5 * texels * (1 - sorted[1] / sorted[2]);
}

TEST_F(FrameCube, NothingIsWrongerAlongTheCubesEdgesThanElsewhere) {
  const auto scene = cage();
  for (const View& view : viewsAbout())
    for (const Rendering& r :
         render(jobOf(scene, view, point(kLamp), {320, 240},
                      {"sm,texels=512", "dv,texels=512,raster=compute", "msf,texels=512", "id,texels=256",
                       "spsm,texels=256,storage=depth-id", "rtw,texels=512", "notw,texels=512"},
                      kAllImages, true))) {
      SCOPED_TRACE(r.result.method.label());
      std::size_t near = 0, nearWrong = 0, far = 0, farWrong = 0;
      for (std::size_t i = 0; i < r.pixels(); ++i) {
        if (!r.answered(i)) continue;
        const bool wrong = (r.visibility(i) >= 0.5) != (r.reference(i) >= 0.5);
        const bool seam = texelsToSeam(r, i, 512) < 6;
        ++(seam ? near : far);
        (seam ? nearWrong : farWrong) += wrong;
      }
      ASSERT_GT(near, 500u);
      EXPECT_LT(r.result.measures->interiorError, 1e-3);
      const double rate = static_cast<double>(farWrong) / static_cast<double>(far);
      EXPECT_LT(rate, 0.04);
      EXPECT_LT(static_cast<double>(nearWrong) / static_cast<double>(near), 2 * rate + 0.01);
    }
}

TEST_F(FrameCube, LargeMapsConvergeToTheRays) {
  const auto scene = cage();
  const View view = viewsAbout().front();
  double before = 0;
  for (const char* text : {"sm,texels=2048", "sm,texels=1024", "sm,texels=512", "sm,texels=256"}) {
    const double wrong = 1 - render(scene, view, point(kLamp), {320, 240}, text).result.measures->pixelMatch;
    EXPECT_GT(wrong, 1.3 * before) << text;
    before = wrong;
  }
}

TEST_F(FrameCube, SingleBecomesACubeOfSmallerMaps) {
  const auto scene = cage();
  const View view = viewsAbout().front();
  const Rendering r = render(scene, view, point(kLamp), {64, 48}, "sm");
  ASSERT_EQ(r.plan.size(), shared::kCubeFaces);
  EXPECT_EQ(r.plan[0].gpu.rectSize, glm::uvec2(1024));
  EXPECT_EQ(r.result.method.label(), "sm,partition=cube");
  EXPECT_EQ(render(scene, view, point(kLamp), {64, 48}, "sm,texels=2048").plan[5].gpu.rectSize,
            glm::uvec2(2048));
}

TEST_F(FrameCube, FacesThatNoSampleFallsOnAreEmpty) {
  const auto scene = emptyRoom();
  const View view{.eye = {0, 0, 0}, .target = {3, 0.1, 0.2}, .verticalFovDegrees = 30};
  const auto empty = [](const Rendering& r) {
    return std::ranges::count_if(r.plan, [](const PlanView& v) { return v.gpu.empty != 0; });
  };
  for (const char* text :
       {"dv,texels=64", "ferko,texels=64", "msf,texels=64", "rtw,texels=64", "notw,texels=64"}) {
    const Rendering r = render(scene, view, point({0, 0, 0}), {64, 48}, text);
    EXPECT_EQ(empty(r), 5) << text;
    EXPECT_EQ(r.result.measures->pixelMatch, 1) << text;
  }
  EXPECT_EQ(empty(render(scene, view, point({0, 0, 0}), {64, 48}, "sm,texels=64")), 0);
  // All of the room lies to one side.
  EXPECT_EQ(empty(render(scene, view, point({0, 30, 0}), {64, 48}, "sm,texels=64")), 5);
}

TEST_F(FrameCube, WhoeverKnowsThePlanThePictureIsTheSame) {
  const auto scene = cage();
  const View view = viewsAbout().front();
  const auto visibility = [&](std::string_view text) {
    return render(scene, view, point(kLamp), {160, 120}, text).images.at(Aov::visibility).bytes;
  };
  for (const std::string name : {"dv,texels=128", "ferko,texels=128", "msf,texels=128", "spsm,texels=128"})
    EXPECT_TRUE(visibility(name) == visibility(name + ",plan=readback")) << name;
  EXPECT_TRUE(visibility("dv,texels=128") == visibility("dv,texels=128,plan=delayed"));
}

// Pixels of one size on a sphere about light and eye: as many texels as pixels to an angle.
TEST_F(FrameCube, EstimationGivesEachFaceItsPixels) {
  const auto scene = emptyRoom();
  const View view{.eye = {0, 0, 0}, .target = {4, 0, 0}, .verticalFovDegrees = 60};
  const glm::uvec2 size{256, 256};
  const Rendering r = render(scene, view, point(view.eye), size, "ferko,plan=readback,texels=2048");
  const auto used = std::ranges::find_if(r.plan, [](const PlanView& v) { return v.gpu.empty == 0; });
  ASSERT_NE(used, r.plan.end());
  EXPECT_NEAR(used->gpu.rectSize.x, size.x + 2, 3);
  EXPECT_NEAR(used->gpu.rectSize.y, size.y + 2, 3);
}

TEST_F(FrameCube, TheObservatorysLampIsRight) {
  const auto scene = builtin("observatory");
  const Light lamp = lightOf(*scene, "lamp");
  for (const char* name : {"main", "floor", "dome"}) {
    const View view = viewOf(*scene, name);
    const auto rs =
        render(jobOf(scene, view, lamp, {320, 320},
                     {"sm,texels=512", "sm,raster=pipeline", "dv", "ferko", "msf", "id,texels=512",
                      "spsm,texels=512,storage=depth-id", "shadow-volumes", "ray-traced"},
                     {}, true));
    const auto wrong = [&](std::size_t i) { return 1 - rs[i].result.measures->pixelMatch; };
    SCOPED_TRACE(name);
    for (std::size_t i = 0; i < rs.size(); ++i) {
      EXPECT_LT(wrong(i), 0.012) << rs[i].result.method.label();
      EXPECT_LT(rs[i].result.measures->interiorError, 2e-3) << rs[i].result.method.label();
    }
    EXPECT_LT(wrong(6), wrong(0)) << "spsm and sm of as many texels";
    EXPECT_LT(wrong(7), 1e-4);
    EXPECT_EQ(wrong(8), 0);
  }
}

}  // namespace
}  // namespace sundial::test
