#version 460
#extension GL_GOOGLE_include_directive : require
// lookup=exact-3x3: lit unless the ray to the light hits a triangle that the texel or one of its eight neighbours holds,
// or all nine say shadow by a plain depth test. Where they all do, triangles may be too small for each to have a texel;
// where they don't, a shadow's edge is near and the triangles that make it are most likely among them.
#include "resolve.glsl"
#include "stored_triangle.glsl"

float lookup(uint view, Receiver r) {
  const ivec2 centre = ivec2(floor(r.texel)), high = ivec2(plan.views[view].rectSize) - 1;
  bool hit = false, anyLit = false;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const ivec2 texel = clamp(centre + ivec2(x, y), ivec2(0), high);
      anyLit = anyLit || litBy(view, r, texel) > 0;
      hit = hit || isHit(r.viewSample, storedTriangle(view, texel));
    }
  return anyLit && !hit ? 1 : 0;
}
