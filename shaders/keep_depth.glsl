// A texel keeps the nearest depth. Depths in [0, 1] are ordered as their bits are.
#ifndef SUNDIAL_KEEP_GLSL
#define SUNDIAL_KEEP_GLSL
#include "bindings.glsl"

void keep(uint index, float depth, uint id) {
  const uint bits = floatBitsToUint(depth);
  // What is read may be old, so it may only be too far.
  if (texelFetch(linearTexels, int(index)).x < bits) atomicMax(linearStore[index], bits);
}

#endif
