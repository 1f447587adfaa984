// A texel keeps the nearest depth and, in the lower half of its 64 bits, whose it is: of equally near triangles the one
// with the greatest number.
#ifndef SUNDIAL_KEEP_GLSL
#define SUNDIAL_KEEP_GLSL
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#include "bindings.glsl"

layout(set = 0, binding = kBindLinear, scalar) buffer LinearIdBlock { uint64_t linearIds[]; };

void keep(uint index, float depth, uint id) {
  const uint bits = floatBitsToUint(depth);
  // What is read may be old, so it may only be too far.
  if (texelFetch(linearTexels, int(index)).y <= bits) atomicMax(linearIds[index], packUint2x32(uvec2(id, bits)));
}

#endif
