// The points on surfaces that stability is asked of.
#include "stability/points.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sundial {
namespace {

TEST(Points, AreSpreadByArea) {
  // Two pixels of equal depth, one facing the camera, one at an angle that makes its surface four times as
  // large.
  shared::FrameConstants constants{};
  constants.clipFromWorld[2][3] = -1;  // looks along -z; w is the depth
  constants.wsRayPerPixelX = {1, 0, 0};
  constants.wsRayPerPixelY = {0, 1, 0};
  const float slant = 0.25f;
  std::vector<shared::ViewSample> samples;
  for (int i = 0; i < 20000; ++i)
    samples.push_back(
        {.wsPosition = {0, 0, -1},
         .instance = 0,
         .wsNormal = i % 2 ? glm::vec3(0, 0, 1) : glm::vec3(std::sqrt(1 - slant * slant), 0, slant),
         .triangle = 0});
  Scene scene;
  scene.clusters.push_back({.firstIndex = 0, .indexCount = 3, .material = 0});
  scene.materials.emplace_back();
  PointChooser chooser(1000, 7);
  chooser.add(0, samples, constants, glm::dvec3(0));
  int large = 0;
  const auto points = chooser.take(scene);
  ASSERT_EQ(points.size(), 1000u);
  for (const SurfacePoint& point : points) large += point.normal.x > 0.5f;
  EXPECT_NEAR(large, 800, 50);
}

}  // namespace
}  // namespace sundial
