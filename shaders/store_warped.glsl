// raster=pipeline: the warp in the vertex shader [NOTW, algorithm 1]. The pipeline draws straight edges between warped
// vertices, which is right where triangles are small against the warp's changes: README.md.
#ifndef SUNDIAL_STORE_WARPED_GLSL
#define SUNDIAL_STORE_WARPED_GLSL
#include "warp.glsl"

// Of a view's clip space.
vec4 warpedClip(uint view, vec4 shadow) {
  if (shadow.w <= 0) return shadow;
  const vec2 size = vec2(warpSize()), p = 0.5 * (shadow.xy / shadow.w + 1) * size;
  // Beyond the map there is nothing to stretch.
  const vec2 inside = clamp(p, vec2(0), size);
  vec2 stretch;
  const vec2 warped = warpedPosition(view, inside, stretch) + (p - inside);
  return vec4((2 * warped / size - 1) * shadow.w, shadow.zw);
}

vec4 warpedVertex(uint view, vec3 wsPosition) {
  return warpedClip(view, plan.views[view].shadowFromWorld * vec4(wsPosition, 1));
}

#endif
