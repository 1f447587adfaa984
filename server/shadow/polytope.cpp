#include "shadow/polytope.h"

#include <algorithm>
#include <cmath>

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
  for (Face& face : faces_) {
    Face kept;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const dvec3 &a = face[i], &b = face[(i + 1) % face.size()];
      const double heightA = glm::dot(plane, dvec4(a, 1)), heightB = glm::dot(plane, dvec4(b, 1));
      if (heightA >= 0) kept.push_back(a);
      if ((heightA >= 0) == (heightB >= 0)) continue;
      kept.push_back(a + (b - a) * (heightA / (heightA - heightB)));
      cut.push_back(kept.back());
    }
    face = std::move(kept);
  }
  std::erase_if(faces_, [](const Face& face) { return face.empty(); });
  if (cut.size() < 3) return;
  orderAround(cut, dvec3(plane));
  faces_.push_back(std::move(cut));
}

}  // namespace sundial
