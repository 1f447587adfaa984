// a b + c, rounded once, as graphics pipelines compute it: lavapipe's fma() in shaders rounds twice.
#ifndef SUNDIAL_FUSED_GLSL
#define SUNDIAL_FUSED_GLSL

// `b` is whole and below 2^14 in size. What the product loses is found by halves [Dekker 1971], what the sum loses by
// [Knuth 1969]; both are added at the end.
vec4 fused(vec4 a, float b, vec4 c) {
  const float bHigh = floor(b * (1 / 128.0)) * 128, bLow = b - bHigh;
  const vec4 aHigh = uintBitsToFloat(floatBitsToUint(a) & 0xfffff000u), aLow = a - aHigh;
  precise const vec4 product = a * b;
  precise const vec4 lost = ((aHigh * bHigh - product) + aHigh * bLow + aLow * bHigh) + aLow * bLow;
  precise const vec4 sum = product + c;
  precise const vec4 cPart = sum - product;
  precise const vec4 lostToo = (product - (sum - cPart)) + (c - cPart);
  precise const vec4 result = sum + (lost + lostToo);
  return result;
}

#endif
