#version 460
#extension GL_GOOGLE_include_directive : require
// lookup=exact-3x3: a plain depth test where a texel and its eight neighbours agree; where they don't, a shadow's edge
// is near, and the rays to the light are tested against the triangles that these texels hold.
#include "resolve.glsl"
#include "stored_depth.glsl"
#include "stored_triangle.glsl"

layout(constant_id = 4) const uint kVariant = 0;

float lookup(uint view, Receiver r) {
  const ivec2 centre = ivec2(floor(r.texel)), high = ivec2(plan.views[view].rectSize) - 1;
  const float plain = litBy(view, r, texelIn(view, r.texel));
  int lit = 0;
  bool hit = false;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const ivec2 texel = clamp(centre + ivec2(x, y), ivec2(0), high);
      lit += int(litBy(view, r, texel));
      hit = hit || isHit(r.viewSample, storedTriangle(view, texel));
    }
  if (kVariant == 0) return hit ? 0.0 : lit == 0 ? 0.0 : 1.0;
  if (kVariant == 1) return hit ? 0.0 : plain;
  if (kVariant == 2) return hit ? 0.0 : 1.0;
  return hit ? 0.0 : lit <= 4 ? 0.0 : 1.0;
}
