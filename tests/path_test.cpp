// Cameras and lights along the keys of a path.
#include "stability/path.h"

#include <gtest/gtest.h>

#include <numbers>

namespace sundial {
namespace {

TEST(Paths, BeginAndEndAtTheirKeys) {
  const std::vector<View> keys{{.eye = {0, 1, 0}, .target = {1, 1, 1}, .verticalFovDegrees = 40},
                               {.eye = {0.1, 7, 3}, .target = {1, 1, 1}, .verticalFovDegrees = 50},
                               {.eye = {0.7, 1, 0.3}, .target = {2, 0.1, 1}, .verticalFovDegrees = 63}};
  for (const unsigned frames : {2u, 3u, 7u, 240u}) {
    const auto views = viewsAlong(keys, frames);
    ASSERT_TRUE(views) << views.error().message;
    ASSERT_EQ(views->size(), frames);
    EXPECT_EQ(views->front().eye, keys.front().eye);
    EXPECT_EQ(views->back().eye, keys.back().eye);
    EXPECT_EQ(views->back().target, keys.back().target);
    EXPECT_EQ(views->back().verticalFovDegrees, 63);
  }
  const auto five = viewsAlong(keys, 5);
  EXPECT_EQ((*five)[2].eye, keys[1].eye);
  EXPECT_EQ((*five)[1].eye, glm::dvec3(0.05, 4, 1.5));
  EXPECT_EQ((*viewsAlong(keys, 1))[0].eye, keys[0].eye);
}

TEST(Paths, StandStillExactlyBetweenEqualKeys) {
  const View view{.eye = {0.1, 0.7, 0.3}, .target = {1.1, 0.9, 0.7}};
  const auto views = viewsAlong(std::vector{view, view, view}, 11);
  ASSERT_TRUE(views);
  for (const View& v : *views) EXPECT_TRUE(v.eye == view.eye && v.target == view.target);
}

TEST(Paths, SayWhereTheyCannotBeFollowed) {
  const View ahead{.eye = {0, 0, 0}, .target = {0, 0, -1}}, behind{.eye = {0, 0, 0}, .target = {0, 0, 1}};
  const auto views = viewsAlong(std::vector{ahead, behind}, 3);
  ASSERT_FALSE(views);
  EXPECT_EQ(views.error().code, ErrorCode::invalidArgument);
  EXPECT_NE(views.error().message.find("keys 0 and 1"), std::string::npos) << views.error().message;
  EXPECT_FALSE(viewsAlong({}, 3));
}

TEST(Paths, LightsTurnFromKeyToKey) {
  const std::vector<Light> keys{{.direction = {1, 0, 0}}, {.direction = {0, -1, 0}}};
  const auto lights = lightsAlong(keys, 3);
  ASSERT_TRUE(lights) << lights.error().message;
  EXPECT_EQ(lights->front().direction, keys[0].direction);
  EXPECT_EQ(lights->back().direction, keys[1].direction);
  EXPECT_NEAR((*lights)[1].direction.x, std::numbers::sqrt2 / 2, 1e-12);
  EXPECT_NEAR(glm::length((*lights)[1].direction), 1, 1e-12);

  EXPECT_FALSE(lightsAlong(std::vector<Light>{{.direction = {1, 0, 0}}, {.direction = {-1, 0, 0}}}, 3));
  const auto mixed = lightsAlong(std::vector<Light>{{.kind = LightKind::spot}, {}}, 3);
  ASSERT_FALSE(mixed);
  EXPECT_NE(mixed.error().message.find("kinds"), std::string::npos);
}

}  // namespace
}  // namespace sundial
