// View samples in the map of the plan's only view.
#ifndef SUNDIAL_WARP_SAMPLES_GLSL
#define SUNDIAL_WARP_SAMPLES_GLSL
#include "light.glsl"
#include "warp.glsl"

// Texels. False where no map answers the sample.
bool positionOf(ViewSample s, out vec2 p) {
  p = vec2(0);
  if (!facesLight(s) || plan.views[0].empty != 0) return false;
  const vec4 light = plan.lightFromWorld * vec4(s.wsPosition, 1);
  if (light.w <= 0) return false;
  const vec3 low = plan.views[0].lsMin, high = plan.views[0].lsMax;
  const vec2 share = (light.xy / light.w - low.xy) / (high.xy - low.xy);
  if (any(lessThan(share, vec2(0))) || any(greaterThan(share, vec2(1)))) return false;
  p = vec2(share.x, 1 - share.y) * vec2(warpSize());  // rows run down
  return true;
}

#endif
