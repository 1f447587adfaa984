// View samples in the maps of the plan: in the only one, or in their faces'.
#ifndef SUNDIAL_WARP_SAMPLES_GLSL
#define SUNDIAL_WARP_SAMPLES_GLSL
#include "light.glsl"
#include "warp.glsl"

// Texels of a view's map. False where no map answers the sample.
bool positionOf(ViewSample s, out uint view, out vec2 p) {
  view = 0;
  p = vec2(0);
  if (!facesLight(s)) return false;
  const vec4 allLight = plan.lightFromWorld * vec4(s.wsPosition, 1);
  if (kCube) view = faceOf(allLight);
  const vec4 light = inViewSpace(view, allLight);
  if (light.w <= 0 || plan.views[view].empty != 0) return false;
  const vec3 low = plan.views[view].lsMin, high = plan.views[view].lsMax;
  const vec2 share = (light.xy / light.w - low.xy) / (high.xy - low.xy);
  if (any(lessThan(share, vec2(0))) || any(greaterThan(share, vec2(1)))) return false;
  p = vec2(share.x, 1 - share.y) * vec2(warpSize());  // rows run down
  return true;
}

#endif
