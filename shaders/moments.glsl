// Exponential variance shadow maps [Lauritzen and McCool 2008]: what is stored of depth.
//
// Two exponentials warp it, e^(c+ z) and -e^(-c- z); a texel holds the means of both and of their squares, and means can
// be filtered. z rises from -1 at the near plane to 1 at the far plane, linearly in metres along the light, of
// whichever kind it is.
// Both planes are the *scene's*, in every view of the plan. So a metre is as steep in a partition of ten metres as in
// one of a thousand, and shadows, and what leaks into them, agree where partitions meet. And a view's own far plane would
// cut the ground off behind its last sample: the filter would find it nearer there than it is, and shadowed by itself.
#ifndef SUNDIAL_MOMENTS_GLSL
#define SUNDIAL_MOMENTS_GLSL
#include "light.glsl"

// Of a depth in shadow space.
float linearDepth(uint view, float depth) {
  depth = clamp(depth, 0, 1);
  if (lightIsFar()) return 1 - 2 * depth;
  const float near = plan.views[view].nearDistance, far = plan.views[view].farDistance;
  return 2 * (1 / mix(1 / far, 1 / near, depth) - near) / (far - near) - 1;
}

// How fast that falls as depth rises.
float linearPerDepth(uint view, float depth) {
  if (lightIsFar()) return 2;
  const float near = plan.views[view].nearDistance, far = plan.views[view].farDistance;
  const float distance_ = 1 / mix(1 / far, 1 / near, clamp(depth, 0, 1));
  return 2 * distance_ * distance_ / (near * far);
}

float linearPerMetre(uint view) { return 2 / (plan.views[view].farDistance - plan.views[view].nearDistance); }

// Both exponentials.
vec2 warped(uint view, float depth) {
  return vec2(1, -1) * exp(vec2(1, -1) * frame.moments.exponents * linearDepth(view, depth));
}

#endif
