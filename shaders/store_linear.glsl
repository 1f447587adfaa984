#ifndef SUNDIAL_STORE_LINEAR_GLSL
#define SUNDIAL_STORE_LINEAR_GLSL
#include "bindings.glsl"

// Depths in [0, 1] are ordered as their bits are.
void keepNearest(uint view) {
  const uvec2 texel = uvec2(gl_FragCoord.xy);
  const uint index = plan.views[view].linearOffset + texel.y * plan.views[view].rectSize.x + texel.x;
  atomicMax(linearStore[index], floatBitsToUint(clamp(gl_FragCoord.z, 0, 1)));
}

#endif
