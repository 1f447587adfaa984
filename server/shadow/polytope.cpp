#include "shadow/polytope.h"

#include <algorithm>
#include <cmath>

#include "shadow/polygon.h"

namespace sundial {

namespace {

using glm::dvec3;
using glm::dvec4;

// Around their middle, in a plane with this normal.
void orderAround(std::vector<dvec3>& corners, const dvec3& normal) {
  dvec3 middle(0);
  for (const dvec3& c : corners) middle += c / static_cast<double>(corners.size());
  const dvec3 least = glm::abs(normal.x) < 0.6 * glm::length(normal) ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 u = glm::normalize(glm::cross(normal, least)), v = glm::cross(glm::normalize(normal), u);
  const auto angle = [&](const dvec3& c) {
    return std::atan2(glm::dot(c - middle, v), glm::dot(c - middle, u));
  };
  std::ranges::sort(corners, {}, angle);
}

}  // namespace

Polytope::Polytope(const dvec3& low, const dvec3& high) {
  for (int axis = 0; axis < 3; ++axis)
    for (const dvec3& at : {low, high}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      Face face(4, at);
      for (std::size_t i = 0; i < 4; ++i) {
        face[i][u] = i == 0 || i == 3 ? low[u] : high[u];
        face[i][v] = i < 2 ? low[v] : high[v];
      }
      faces_.push_back(std::move(face));
    }
}

void Polytope::clip(const dvec4& plane) {
  Face cut;
  const auto height = [&](const dvec3& p) { return glm::dot(plane, dvec4(p, 1)); };
  for (Face& face : faces_) sundial::clip(face, height, [&](const dvec3& corner) { cut.push_back(corner); });
  std::erase_if(faces_, [](const Face& face) { return face.empty(); });
  if (cut.size() < 3) return;
  orderAround(cut, dvec3(plane));
  faces_.push_back(std::move(cut));
}

}  // namespace sundial
