#version 460
#extension GL_GOOGLE_include_directive : require
// lookup=pcf: percentage-closer filtering [Reeves et al. 1987], a box of frame.pcfKernel texels a side centred on the
// sample itself: texels at the box's rim count by the share that it covers, so that the result is continuous.
#include "resolve.glsl"
#include "stored_depth.glsl"

float lookup(uint view, Receiver r) {
  const vec2 corner = r.texel - 0.5 * float(frame.pcfKernel);
  const ivec2 first = ivec2(floor(corner));
  const vec2 cut = corner - vec2(first);
  const ivec2 high = ivec2(plan.views[view].rectSize) - 1;
  const int kernel = int(frame.pcfKernel);
  float lit = 0;
  for (int y = 0; y <= kernel; ++y) {
    const float wy = y == 0 ? 1 - cut.y : y == kernel ? cut.y : 1.0;
    for (int x = 0; x <= kernel; ++x) {
      const float wx = x == 0 ? 1 - cut.x : x == kernel ? cut.x : 1.0;
      lit += wx * wy * litBy(view, r, clamp(first + ivec2(x, y), ivec2(0), high));
    }
  }
  return min(lit / float(kernel * kernel), 1);  // the weights' sum may round up
}
