// The camera's frustum as lines in the world.
#pragma once

#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "sundial/v1/sundial.pb.h"

namespace sundial::page {

class Frustum {
 public:
  // `aspect` is width / height of the picture. The view's eye, target and up make sense.
  Frustum(const v1::View&, double aspect);

  // Camera depth of a world point, metres.
  double depthOf(glm::dvec3 wsPoint) const { return glm::dot(wsPoint - wsEye_, wsForward_); }

  using Line = std::pair<glm::dvec3, glm::dvec3>;
  std::vector<Line> edges(double depth) const;  // four, from the eye
  std::vector<Line> slice(double depth) const;  // four, around what the camera sees at that depth

 private:
  glm::dvec3 corner(int index, double depth) const;  // index in [0, 4], around; 4 is 0

  glm::dvec3 wsEye_, wsForward_, wsRight_, wsUp_;  // right and up reach to the picture's rim at depth 1
};

}  // namespace sundial::page
