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

// The direction in the world in which a coordinate grows.
glm::dvec3 rowOf(const glm::dmat4& matrix, int row) {
  return {matrix[0][row], matrix[1][row], matrix[2][row]};
}

// A face and its rim, turned by whatever angle, stays within its cell.
constexpr double kFaceSpacing = 3;

}  // namespace

std::optional<LightSpace::Plane> LightSpace::planeOf(const v1::PlanView& view,
                                                     std::optional<glm::dvec3> wsLightAxis) {
  const auto matrix = shadowFromWorld(view);
  if (!matrix) return std::nullopt;
  const glm::dvec3 wsAxis = wsLightAxis.value_or(rowOf(*matrix, 3));
  if (glm::length(wsAxis) == 0) return std::nullopt;
  Plane plane{.wsAxis = glm::normalize(wsAxis)};
  // The view's first row grows to its right; what of it lies across the axis is our right.
  const glm::dvec3 wsRow = rowOf(*matrix, 0);
  const glm::dvec3 wsRight = wsRow - glm::dot(wsRow, plane.wsAxis) * plane.wsAxis;
  if (glm::length(wsRight) == 0) return std::nullopt;
  plane.wsRight = glm::normalize(wsRight);
  plane.wsDown = glm::cross(plane.wsAxis, plane.wsRight);
  if (glm::dot(plane.wsDown, rowOf(*matrix, 1)) < 0) plane.wsDown = -plane.wsDown;
  return plane;
}

std::optional<LightSpace> LightSpace::of(const v1::Light& light, const v1::Plan& plan) {
  const auto first =
      std::ranges::find_if(plan.views(), [](const v1::PlanView& view) { return !view.empty(); });
  if (first == plan.views().end()) return std::nullopt;
  LightSpace space;
  if (light.has_point()) {
    space.wsEye_ = vec(light.point().position());
    for (int face = 0; face < plan.views_size(); ++face) {
      auto plane = planeOf(plan.views(face), std::nullopt);
      if (!plane) return std::nullopt;
      plane->at = kFaceSpacing * glm::dvec2(face % 3, face / 3);
      space.planes_.push_back(*plane);
    }
    return space;
  }
  if (light.has_spot()) space.wsEye_ = vec(light.spot().eye());
  const glm::dvec3 wsAxis =
      light.has_spot() ? vec(light.spot().target()) - vec(light.spot().eye()) : vec(light.sun().direction());
  const auto plane = planeOf(*first, wsAxis);
  if (!plane) return std::nullopt;
  space.planes_.push_back(*plane);
  return space;
}

std::size_t LightSpace::planeAt(glm::dvec3 wsPoint) const {
  const auto along = [&](const Plane& plane) {
    return glm::dot(plane.wsAxis, wsPoint - wsEye_.value_or(glm::dvec3(0)));
  };
  return static_cast<std::size_t>(std::ranges::max_element(planes_, {}, along) - planes_.begin());
}

std::optional<glm::dvec2> LightSpace::project(const Plane& plane, glm::dvec3 wsPoint) const {
  const glm::dvec3 wsOffset = wsPoint - wsEye_.value_or(glm::dvec3(0));
  const glm::dvec2 across{glm::dot(plane.wsRight, wsOffset), glm::dot(plane.wsDown, wsOffset)};
  if (!wsEye_) return across;
  const double depth = glm::dot(plane.wsAxis, wsOffset);
  if (depth <= 0) return std::nullopt;
  return plane.at + across / depth;
}

std::optional<glm::dvec2> LightSpace::project(glm::dvec3 wsPoint) const {
  return project(planes_[planeAt(wsPoint)], wsPoint);
}

std::optional<std::vector<glm::dvec2>> LightSpace::outline(const v1::PlanView& view) const {
  const auto matrix = shadowFromWorld(view);
  if (!matrix) return std::nullopt;
  const glm::dmat4 worldFromShadow = glm::inverse(*matrix);
  const auto world = [&](glm::dvec2 at) {
    const glm::dvec4 p = worldFromShadow * glm::dvec4(at, 0.5, 1);
    return glm::dvec3(p) / p.w;
  };
  // Of a face the one that it looks along: its map's rim lies in the next one's pyramid.
  const glm::dvec3 wsAlong = rowOf(*matrix, 3);
  const Plane& plane = planes_[wsEye_ ? planeAt(*wsEye_ + wsAlong) : 0];
  std::vector<glm::dvec2> corners;
  for (const glm::dvec2 corner : {glm::dvec2{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const auto point = project(plane, world(corner));
    if (!point || !std::isfinite(point->x) || !std::isfinite(point->y)) return std::nullopt;
    corners.push_back(*point);
  }
  return corners;
}

}  // namespace sundial::page
