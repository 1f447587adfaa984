#include "shadow/minimal_frustum.h"

#include <algorithm>

#include "shadow/convex_hull.h"
#include "shadow/lit_outline.h"
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

// What a map holds: a box in light space after division, turned so that `axis` is its x axis. Low above high
// where nothing is seen.
struct Fit {
  dvec2 axis{1, 0};
  dvec3 low{1}, high{-1};
};

// Around what could be seen lit; as near as a box that casts into it.
Fit fitted(const LitPart& part, const glm::uvec2& texels, double nearestZ, const PlacedClusters& clusters) {
  const Outline outline = litOutline(part, clusters);
  const Rectangle rectangle = smallestRectangle(outline.corners, dvec2(texels));
  if (rectangle.empty()) return {};

  // What lies above the rectangle casts into it.
  const dmat4 turned(turnedAbout(part.lightFromWorld, rectangle.axis));
  double nearZ = outline.farZ;
  for (const WorldBox& box : clusters.boxes()) {
    const LightBox its = lightBox(box, turned);
    const bool above = its.low.x <= rectangle.high.x && its.high.x >= rectangle.low.x &&
                       its.low.y <= rectangle.high.y && its.high.y >= rectangle.low.y;
    if (above) nearZ = std::max(nearZ, its.high.z);
  }
  return {rectangle.axis, {rectangle.low, outline.farZ}, {rectangle.high, std::min(nearZ, nearestZ)}};
}

}  // namespace

void fitMinimalFrustum(shared::FrameConstants& c, const PlacedClusters& clusters) {
  const Fit fit = fitted(litPart(c), c.settings.mapSize, c.lsBoundsMax.z, clusters);
  turnLightSpace(c, fit.axis);
  c.settings.lsFitMin = fit.low;
  c.settings.lsFitMax = fit.high;
}

void fitMinimalFaces(shared::FrameConstants& c, const PlacedClusters& clusters) {
  for (std::uint32_t face = 0; face < shared::kCubeFaces; ++face) {
    const Fit fit = fitted(litPartOfFace(c, face), c.settings.mapSize, c.lsFaceMax[face].z, clusters);
    c.faceTurn[face] = fit.axis;
    c.lsFaceMin[face] = fit.low;
    c.lsFaceMax[face] = fit.high;
  }
}

}  // namespace sundial
