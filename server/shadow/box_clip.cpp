#include "shadow/box_clip.h"

#include "shadow/polytope.h"

namespace sundial {

namespace {

using glm::dvec3;
using glm::dvec4;

enum class Side { inside, across, outside };

Side sideOf(const WorldBox& box, const dvec4& plane) {
  const double middle = glm::dot(plane, dvec4(dvec3(box.centre), 1));
  const double reach = glm::dot(glm::abs(dvec3(plane)), dvec3(box.extent));
  return middle + reach < 0 ? Side::outside : middle - reach < 0 ? Side::across : Side::inside;
}

}  // namespace

Planes pyramidOf(const glm::dmat4& lightFromWorld, double reach, double near) {
  const glm::dmat4 rows = glm::transpose(lightFromWorld);
  Planes planes;
  for (int axis = 0; axis < 2; ++axis) {
    planes.push_back(reach * rows[3] + rows[axis]);
    planes.push_back(reach * rows[3] - rows[axis]);
  }
  planes.push_back(rows[3] - dvec4(0, 0, 0, near));
  return planes;
}

dvec3 cornerOf(const WorldBox& box, int corner) {
  const dvec3 signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
  return dvec3(box.centre) + signs * dvec3(box.extent);
}

std::optional<Planes> cutting(const WorldBox& box, const Planes& planes) {
  Planes across;
  for (const dvec4& plane : planes) {
    const Side side = sideOf(box, plane);
    if (side == Side::outside) return std::nullopt;
    if (side == Side::across) across.push_back(plane);
  }
  return across;
}

void eachCornerWithin(const WorldBox& box, const Planes& planes,
                      const std::function<void(const dvec3&)>& each) {
  const std::optional<Planes> across = cutting(box, planes);
  if (!across) return;
  if (across->empty()) {
    for (int i = 0; i < 8; ++i) each(cornerOf(box, i));
    return;
  }
  Polytope seen(dvec3(box.centre - box.extent), dvec3(box.centre + box.extent));
  for (const dvec4& plane : *across) seen.clip(plane);
  seen.eachCorner(each);
}

}  // namespace sundial
