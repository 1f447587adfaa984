#include "page/light_space.h"

#include <algorithm>
#include <cmath>

namespace sundial::page {
namespace {

glm::dvec3 vec(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

// The contract writes row by row; glm keeps columns.
std::optional<glm::dmat4> shadowFromWorld(const v1::PlanView& view) {
  if (view.shadow_from_world_size() != 16) return std::nullopt;
  glm::dmat4 matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix[column][row] = view.shadow_from_world(4 * row + column);
  return matrix;
}

}  // namespace

std::optional<LightSpace> LightSpace::of(const v1::Light& light, const v1::Plan& plan) {
  const auto first =
      std::ranges::find_if(plan.views(), [](const v1::PlanView& view) { return !view.empty(); });
  if (first == plan.views().end()) return std::nullopt;
  const auto matrix = shadowFromWorld(*first);
  LightSpace space;
  if (light.has_sun()) {
    space.wsAxis_ = vec(light.sun().direction());
  } else if (light.has_spot()) {
    space.spot_ = true;
    space.wsEye_ = vec(light.spot().eye());
    space.wsAxis_ = vec(light.spot().target()) - space.wsEye_;
  }
  if (!matrix || glm::length(space.wsAxis_) == 0) return std::nullopt;
  space.wsAxis_ = glm::normalize(space.wsAxis_);

  // The view's first row grows to its right; what of it lies across the axis is our right.
  const glm::dvec3 wsRow{(*matrix)[0][0], (*matrix)[1][0], (*matrix)[2][0]};
  const glm::dvec3 wsDownRow{(*matrix)[0][1], (*matrix)[1][1], (*matrix)[2][1]};
  const glm::dvec3 wsRight = wsRow - glm::dot(wsRow, space.wsAxis_) * space.wsAxis_;
  if (glm::length(wsRight) == 0) return std::nullopt;
  space.wsRight_ = glm::normalize(wsRight);
  space.wsDown_ = glm::cross(space.wsAxis_, space.wsRight_);
  if (glm::dot(space.wsDown_, wsDownRow) < 0) space.wsDown_ = -space.wsDown_;
  return space;
}

std::optional<glm::dvec2> LightSpace::project(glm::dvec3 wsPoint) const {
  const glm::dvec3 wsOffset = wsPoint - wsEye_;
  const glm::dvec2 across{glm::dot(wsRight_, wsOffset), glm::dot(wsDown_, wsOffset)};
  if (!spot_) return across;
  const double depth = glm::dot(wsAxis_, wsOffset);
  if (depth <= 0) return std::nullopt;
  return across / depth;
}

std::optional<std::vector<glm::dvec2>> LightSpace::outline(const v1::PlanView& view) const {
  const auto matrix = shadowFromWorld(view);
  if (!matrix) return std::nullopt;
  const glm::dmat4 worldFromShadow = glm::inverse(*matrix);
  std::vector<glm::dvec2> corners;
  for (const glm::dvec2 corner : {glm::dvec2{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const glm::dvec4 world = worldFromShadow * glm::dvec4(corner, 0.5, 1);
    const auto point = project(glm::dvec3(world) / world.w);
    if (!point || !std::isfinite(point->x) || !std::isfinite(point->y)) return std::nullopt;
    corners.push_back(*point);
  }
  return corners;
}

}  // namespace sundial::page
