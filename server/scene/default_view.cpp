// Where to look from, and what light to use, when nobody says.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/scene.h"

namespace sundial {

// Looks at the centre from above the corner of the largest coordinates, from as near as shows all eight
// corners in a square image, with a margin of 5 %.
View defaultView(const Scene& scene) {
  const Bounds& bounds = scene.bounds;
  View view;
  view.verticalFovDegrees = 50;
  view.target = bounds.centre();

  const glm::dvec3 backward = glm::normalize(glm::dvec3(1, 0.8, 1));
  const glm::dvec3 right = glm::normalize(glm::cross(view.up, backward));
  const glm::dvec3 up = glm::cross(backward, right);
  const double tangent = std::tan(glm::radians(view.verticalFovDegrees / 2));
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p =
        glm::dvec3(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                   corner & 4 ? bounds.max.z : bounds.min.z) -
        view.target;
    const double across = std::max(std::abs(glm::dot(p, right)), std::abs(glm::dot(p, up)));
    distance = std::max(distance, across / tangent + glm::dot(p, backward));
  }
  view.eye = view.target + backward * (distance > 0 ? distance * 1.05 : 1.0);
  return view;
}

// From the side as the default view sees it, so that shadows show.
Light defaultLight(const Scene&) {
  const double elevation = glm::radians(50.0), azimuth = glm::radians(120.0);
  Light light;
  light.kind = LightKind::directional;
  light.direction = -glm::dvec3(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                                std::cos(elevation) * std::sin(azimuth));
  return light;
}

}  // namespace sundial
