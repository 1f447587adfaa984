#include "shadow/minimal_frustum.h"

#include <algorithm>
#include <vector>

#include "shadow/box_clip.h"
#include "shadow/convex_hull.h"
#include "shadow/plan_settings.h"

namespace sundial {

namespace {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

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

// The camera's sides, without near and far.
Planes cameraSides(const shared::FrameConstants& c) {
  const dmat4 rows = glm::transpose(dmat4(c.clipFromWorld));
  return {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1]};
}

// And what of light space holds the scene, or the spot light's pyramid from its near plane on: tighter than
// the boxes of the clusters at its sides.
Planes planesOf(const shared::FrameConstants& c) {
  Planes planes = cameraSides(c);
  const dmat4 light = glm::transpose(dmat4(c.lightFromWorld));
  for (int axis = 0; axis < 2; ++axis) {
    planes.push_back(light[axis] - double{c.lsBoundsMin[axis]} * light[3]);
    planes.push_back(double{c.lsBoundsMax[axis]} * light[3] - light[axis]);
  }
  if (c.lightKind != shared::kLightDirectional)
    planes.push_back(light[3] - dvec4(0, 0, 0, 1 / c.lsBoundsMax.z));
  return planes;
}

// What a map holds: a box in light space after division, turned so that `axis` is its x axis. Low above high
// where nothing is seen.
struct Fit {
  dvec2 axis{1, 0};
  dvec3 low{1}, high{-1};
};

// Around what of the boxes lies within the planes; as near as one that casts into it.
Fit fitted(const glm::mat4& lightFromWorld, const Planes& planes, double nearestZ,
           std::span<const WorldBox> boxes) {
  const dmat4 before(lightFromWorld);
  std::vector<dvec2> seen;
  double farZ = 1e300;
  for (const WorldBox& box : boxes)
    eachCornerWithin(box, planes, [&](const dvec3& corner) {
      const dvec4 light = before * dvec4(corner, 1);
      seen.push_back(dvec2(light) / light.w);
      farZ = std::min(farZ, light.z / light.w);
    });
  const Rectangle rectangle = smallestRectangle(convexHull(seen));
  if (rectangle.empty()) return {};

  // What lies above the rectangle casts into it.
  const dmat4 turned(turnedAbout(lightFromWorld, rectangle.axis));
  double nearZ = farZ;
  for (const WorldBox& box : boxes) {
    const LightBox its = lightBox(box, turned);
    const bool above = its.low.x <= rectangle.high.x && its.high.x >= rectangle.low.x &&
                       its.low.y <= rectangle.high.y && its.high.y >= rectangle.low.y;
    if (above) nearZ = std::max(nearZ, its.high.z);
  }
  return {rectangle.axis, {rectangle.low, farZ}, {rectangle.high, std::min(nearZ, nearestZ)}};
}

}  // namespace

void fitMinimalFrustum(shared::FrameConstants& c, std::span<const WorldBox> boxes) {
  const Fit fit = fitted(c.lightFromWorld, planesOf(c), c.lsBoundsMax.z, boxes);
  turnLightSpace(c, fit.axis);
  c.settings.lsFitMin = fit.low;
  c.settings.lsFitMax = fit.high;
}

void fitMinimalFaces(shared::FrameConstants& c, std::span<const WorldBox> boxes) {
  for (std::uint32_t face = 0; face < shared::kCubeFaces; ++face) {
    const glm::mat4 faceFromWorld = shared::faceFromWorld(face, {1, 0}, c.lightFromWorld);
    Planes planes = cameraSides(c);
    for (const dvec4& plane : pyramidOf(dmat4(faceFromWorld), 1, c.nearDistance)) planes.push_back(plane);
    const Fit fit = fitted(faceFromWorld, planes, c.lsFaceMax[face].z, boxes);
    c.faceTurn[face] = fit.axis;
    c.lsFaceMin[face] = fit.low;
    c.lsFaceMax[face] = fit.high;
  }
}

}  // namespace sundial
