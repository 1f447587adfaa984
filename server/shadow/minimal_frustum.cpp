#include "shadow/minimal_frustum.h"

#include <algorithm>
#include <array>
#include <vector>

#include "shadow/convex_hull.h"
#include "shadow/plan_settings.h"
#include "shadow/polytope.h"

namespace sundial {

namespace {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

// Planes that point inwards.
using Planes = std::vector<dvec4>;

// The camera's sides, without near and far; and the pyramid of a spot light, from its near plane on.
Planes planesOf(const shared::FrameConstants& c) {
  const dmat4 camera = glm::transpose(dmat4(c.clipFromWorld)),
              light = glm::transpose(dmat4(c.lightFromWorld));
  Planes planes{camera[3] + camera[0], camera[3] - camera[0], camera[3] + camera[1], camera[3] - camera[1]};
  if (c.lightKind == shared::kLightDirectional) return planes;
  for (int axis = 0; axis < 2; ++axis) {
    planes.push_back(light[axis] - double{c.lsBoundsMin[axis]} * light[3]);
    planes.push_back(double{c.lsBoundsMax[axis]} * light[3] - light[axis]);
  }
  planes.push_back(light[3] - dvec4(0, 0, 0, 1 / c.lsBoundsMax.z));
  return planes;
}

enum class Side { inside, across, outside };

Side sideOf(const WorldBox& box, const dvec4& plane) {
  const double middle = glm::dot(plane, dvec4(dvec3(box.centre), 1));
  const double reach = glm::dot(glm::abs(dvec3(plane)), dvec3(box.extent));
  return middle + reach < 0 ? Side::outside : middle - reach < 0 ? Side::across : Side::inside;
}

dvec3 cornerOf(const WorldBox& box, int i) {
  return dvec3(box.centre) + dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1) * dvec3(box.extent);
}

// Calls `each` with points whose hull holds what of the box the planes leave.
template <class Function>
void eachSeenCorner(const WorldBox& box, const Planes& planes, Function each) {
  Planes across;
  for (const dvec4& plane : planes) {
    const Side side = sideOf(box, plane);
    if (side == Side::outside) return;
    if (side == Side::across) across.push_back(plane);
  }
  if (across.empty()) {
    for (int i = 0; i < 8; ++i) each(cornerOf(box, i));
    return;
  }
  Polytope seen(dvec3(box.centre - box.extent), dvec3(box.centre + box.extent));
  for (const dvec4& plane : across) seen.clip(plane);
  seen.eachCorner(each);
}

// In light space after division; without bounds beside a spot light.
struct LightBox {
  dvec3 low{1e300}, high{-1e300};
};

LightBox lightBox(const WorldBox& box, const dmat4& lightFromWorld) {
  LightBox out;
  for (int i = 0; i < 8; ++i) {
    const dvec4 light = lightFromWorld * dvec4(cornerOf(box, i), 1);
    if (light.w <= 0) return {dvec3(-1e300), dvec3(1e300)};
    out.low = glm::min(out.low, dvec3(light) / light.w);
    out.high = glm::max(out.high, dvec3(light) / light.w);
  }
  return out;
}

}  // namespace

void fitMinimalFrustum(shared::FrameConstants& c, std::span<const WorldBox> boxes) {
  const Planes planes = planesOf(c);
  const dmat4 before(c.lightFromWorld);
  std::vector<dvec2> seen;
  double farZ = 1e300;
  for (const WorldBox& box : boxes)
    eachSeenCorner(box, planes, [&](const dvec3& corner) {
      const dvec4 light = before * dvec4(corner, 1);
      seen.push_back(dvec2(light) / light.w);
      farZ = std::min(farZ, light.z / light.w);
    });
  const Rectangle rectangle = smallestRectangle(convexHull(seen));
  if (rectangle.empty()) {
    c.settings.lsFitMin = glm::vec3(1);
    c.settings.lsFitMax = glm::vec3(-1);
    return;
  }
  turnLightSpace(c, rectangle.axis);

  // What lies above the rectangle casts into it.
  const dmat4 turned(c.lightFromWorld);
  double nearZ = farZ;
  for (const WorldBox& box : boxes) {
    const LightBox its = lightBox(box, turned);
    const bool above = its.low.x <= rectangle.high.x && its.high.x >= rectangle.low.x &&
                       its.low.y <= rectangle.high.y && its.high.y >= rectangle.low.y;
    if (above) nearZ = std::max(nearZ, its.high.z);
  }
  c.settings.lsFitMin = glm::vec3(rectangle.low, farZ);
  c.settings.lsFitMax = glm::vec3(rectangle.high, std::min(nearZ, double{c.lsBoundsMax.z}));
}

}  // namespace sundial
