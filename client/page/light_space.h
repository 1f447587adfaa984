// The plane of the light in which plans are drawn: metres across the sun's direction, or the tangents of
// angles from a spot's axis. A point light has six, one a face of the cube about it, side by side.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "sundial/v1/sundial.pb.h"

namespace sundial::page {

class LightSpace {
 public:
  // Turned as the plan's first view that isn't empty, so that its texels are upright; each face as its own
  // view. Nothing without such a view.
  static std::optional<LightSpace> of(const v1::Light&, const v1::Plan&);

  // Where a world point lies; nothing behind a spot.
  std::optional<glm::dvec2> project(glm::dvec3 wsPoint) const;
  // On which plane that is.
  std::size_t planeAt(glm::dvec3 wsPoint) const;

  // The four corners of a view's rectangle, in the order of its rows and columns; nothing if one has no
  // image.
  std::optional<std::vector<glm::dvec2>> outline(const v1::PlanView&) const;

  bool metres() const { return !wsEye_; }

 private:
  struct Plane {
    glm::dvec3 wsAxis{0}, wsRight{0}, wsDown{0};
    glm::dvec2 at{0};  // where its middle is drawn
  };
  // Across the view's own axis, or the light's where it is given; nothing for a view that has none.
  static std::optional<Plane> planeOf(const v1::PlanView&, std::optional<glm::dvec3> wsLightAxis);
  std::optional<glm::dvec2> project(const Plane&, glm::dvec3 wsPoint) const;

  std::optional<glm::dvec3> wsEye_;  // of a light at a place
  std::vector<Plane> planes_;
};

}  // namespace sundial::page
