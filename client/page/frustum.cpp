#include "page/frustum.h"

#include <cmath>

namespace sundial::page {
namespace {

glm::dvec3 vec(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

Frustum::Frustum(const v1::View& view, double aspect)
    : wsEye_(vec(view.eye())), wsForward_(glm::normalize(vec(view.target()) - wsEye_)) {
  const glm::dvec3 up = view.has_up() ? vec(view.up()) : glm::dvec3(0, 1, 0);
  const double rise = std::tan(glm::radians(view.vertical_fov_degrees()) / 2);
  const glm::dvec3 right = glm::normalize(glm::cross(wsForward_, up));
  wsUp_ = rise * glm::cross(right, wsForward_);
  wsRight_ = rise * aspect * right;
}

glm::dvec3 Frustum::corner(int index, double depth) const {
  const double x = index == 1 || index == 2 ? 1 : -1, y = index >= 2 && index < 4 ? 1 : -1;
  return wsEye_ + depth * (wsForward_ + x * wsRight_ + y * wsUp_);
}

std::vector<Frustum::Line> Frustum::edges(double depth) const {
  std::vector<Line> lines;
  for (int i = 0; i < 4; ++i) lines.emplace_back(wsEye_, corner(i, depth));
  return lines;
}

std::vector<Frustum::Line> Frustum::slice(double depth) const {
  std::vector<Line> lines;
  for (int i = 0; i < 4; ++i) lines.emplace_back(corner(i, depth), corner(i + 1, depth));
  return lines;
}

}  // namespace sundial::page
