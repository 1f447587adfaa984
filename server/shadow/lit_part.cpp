#include "shadow/lit_part.h"

#include <cmath>

namespace sundial {

namespace {

using glm::dmat4;
using glm::dvec4;

// Without near and far.
Planes cameraSides(const shared::FrameConstants& c) {
  const dmat4 rows = glm::transpose(dmat4(c.clipFromWorld));
  return {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1]};
}

double coneRadius(const shared::FrameConstants& c) {
  const double cosine = double{c.lightCosCone} - 1e-6;  // what rounds into the cone, too
  return std::sqrt(1 / (cosine * cosine) - 1);
}

}  // namespace

LitPart litPart(const shared::FrameConstants& c) {
  LitPart part{c.lightFromWorld, cameraSides(c), Onlookers(c)};
  // What of light space holds the scene, or a spot's pyramid from its near plane on: tighter than the boxes
  // of the clusters at its sides.
  const dmat4 light = glm::transpose(dmat4(c.lightFromWorld));
  for (int axis = 0; axis < 2; ++axis) {
    part.planes.push_back(light[axis] - double{c.lsBoundsMin[axis]} * light[3]);
    part.planes.push_back(double{c.lsBoundsMax[axis]} * light[3] - light[axis]);
  }
  if (c.lightKind != shared::kLightDirectional)
    part.planes.push_back(light[3] - dvec4(0, 0, 0, 1 / c.lsBoundsMax.z));
  if (c.lightKind == shared::kLightSpot) part.coneRadius = coneRadius(c);
  return part;
}

LitPart litPartOfFace(const shared::FrameConstants& c, std::uint32_t face) {
  LitPart part{shared::faceFromWorld(face, {1, 0}, c.lightFromWorld), cameraSides(c), Onlookers(c)};
  for (const dvec4& plane : pyramidOf(dmat4(part.lightFromWorld), 1, c.nearDistance))
    part.planes.push_back(plane);
  return part;
}

}  // namespace sundial
