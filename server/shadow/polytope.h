// A convex solid that planes cut.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace sundial {

class Polytope {
 public:
  // A box with faces across the axes.
  Polytope(const glm::dvec3& low, const glm::dvec3& high);
  // Keeps what has dot(plane, (p, 1)) >= 0.
  void clip(const glm::dvec4& plane);
  // Calls `each` with every corner, at least once.
  template <class Function>
  void eachCorner(const Function& each) const {
    for (const Face& face : faces_)
      for (const glm::dvec3& corner : face) each(corner);
  }

 private:
  using Face = std::vector<glm::dvec3>;  // corners in order around it
  std::vector<Face> faces_;
};

}  // namespace sundial
