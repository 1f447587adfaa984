// A texel keeps the nearest depth. Depths in [0, 1] are ordered as their bits are.
#ifndef SUNDIAL_KEEP_GLSL
#define SUNDIAL_KEEP_GLSL
#include "bindings.glsl"

void keep(uint index, float depth, uint id) { atomicMax(linearStore[index], floatBitsToUint(depth)); }

#endif
