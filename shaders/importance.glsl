// How much a rectilinear warp cares for a place of the scene: a weighted sum of functions, each in [0, 1]
// [Rosen 2012, as NOTW section 2.2 describes it]; and the most of each column and row.
#ifndef SUNDIAL_IMPORTANCE_GLSL
#define SUNDIAL_IMPORTANCE_GLSL
#include "ordered.glsl"
#include "stored_depth.glsl"
#include "view_depth.glsl"

float weightOf(uint function) { return frame.settings.warpWeights[function]; }

float nearness(vec3 wsPosition) {
  const float depth = max(viewDepth(wsPosition, false), frame.nearDistance);
  return min(floatFromOrdered(analysis.depthMin) / depth, 1);
}

// Texels of the map without a warp that a pixel there is wide and high, on a surface with this normal: the derivatives of
// where the pixel's ray meets the surface's plane, in light space. Fewer ask for more.
vec2 pixelTexels(uint view, vec3 wsPosition, vec3 wsNormal) {
  const vec3 to = wsPosition - frame.wsEye;
  const float depth = viewDepth(wsPosition, false);
  const vec4 light = pointInView(view, wsPosition);
  const vec2 ls = light.xy / light.w;
  vec2 extent = vec2(0);
  for (int axis = 0; axis < 2; ++axis) {
    const vec3 ray = axis == 0 ? frame.wsRayPerPixelX : frame.wsRayPerPixelY;
    const vec3 step_ = depth * ray - to * (depth * dot(wsNormal, ray) / min(dot(wsNormal, to), -1e-6 * depth));
    const vec4 moved = directionInView(view, step_);
    extent += abs(moved.xy - ls * moved.w) / light.w;
  }
  return extent / plan.views[view].texelSize;
}

// Saturates: what asks for more is a sliver, which light or camera graze, and would decide for all.
const float kMostDensity = 64;
vec2 density(uint view, vec3 wsPosition, vec3 wsNormal) {
  return min(1 / (kMostDensity * max(pixelTexels(view, wsPosition, wsNormal), vec2(1e-6))), vec2(1));
}

// Whether a shadow's edge passes the texel of the light's map: a step of depth by more than kSteps of its sides, where a plane
// has none.
const float kSteps = 4;
bool isShadowEdge(uint view, ivec2 texel) {
  const ivec2 last = ivec2(plan.views[view].rectSize) - 1;
  const float here = storedDepth(view, texel);
  float bend = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const ivec2 step_ = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
    const float before = storedDepth(view, max(texel - step_, ivec2(0)));
    const float after = storedDepth(view, min(texel + step_, last));
    if (before > 0 && after > 0) bend = max(bend, abs(before + after - 2 * here));
  }
  // In light space; of a light that has a place reciprocals, whose steps grow with the square of distance, as texels do with distance.
  const float lsLow = plan.views[view].lsMin.z, lsBend = bend * (plan.views[view].lsMax.z - lsLow);
  const float lsHere = lsLow + here * (plan.views[view].lsMax.z - lsLow);
  const float perSide = lightIsFar() ? 1 : 1 / max(lsHere, 1e-30);
  return here > 0 && lsBend * perSide > kSteps * max(plan.views[view].texelSize.x, plan.views[view].texelSize.y);
}

// Floats of at least 0 are ordered as their bits are.
void raise(uint at, float value) {
  const uint bits = floatBitsToUint(value);
  if (importance[at] < bits) atomicMax(importance[at], bits);
}

void makeImportant(uint view, uvec2 texel, vec2 value) {
  raise(importanceAt(view) + texel.x, value.x);
  raise(importanceAt(view) + warpSize().x + texel.y, value.y);
}

#endif
