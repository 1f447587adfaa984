// The plane of the light in which plans are drawn: metres across the sun's direction, or the tangent of the
// angle from a spot's axis.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "sundial/v1/sundial.pb.h"

namespace sundial::page {

class LightSpace {
 public:
  // Turned as the plan's first view that isn't empty, so that its texels are upright. Nothing without such a
  // view, or for a point light, which has no such plane.
  static std::optional<LightSpace> of(const v1::Light&, const v1::Plan&);

  // Where a world point lies; nothing behind a spot.
  std::optional<glm::dvec2> project(glm::dvec3 wsPoint) const;

  // The four corners of a view's rectangle, in the order of its rows and columns; nothing if one has no
  // image.
  std::optional<std::vector<glm::dvec2>> outline(const v1::PlanView&) const;

  bool metres() const { return !spot_; }

 private:
  glm::dvec3 wsEye_{0}, wsAxis_{0}, wsRight_{0}, wsDown_{0};
  bool spot_ = false;
};

}  // namespace sundial::page
