// A code of floats whose unsigned order is the floats' order.
#ifndef SUNDIAL_ORDERED_GLSL
#define SUNDIAL_ORDERED_GLSL

uint orderedFromFloat(float f) {
  const uint u = floatBitsToUint(f);
  return u ^ ((u >> 31) != 0u ? 0xffffffffu : 0x80000000u);
}

float floatFromOrdered(uint o) { return uintBitsToFloat(o ^ ((o >> 31) != 0u ? 0x80000000u : 0xffffffffu)); }

#endif
