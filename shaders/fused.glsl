// a b + c, rounded once, as graphics pipelines compute it: lavapipe's fma() in shaders rounds twice.
#ifndef SUNDIAL_FUSED_GLSL
#define SUNDIAL_FUSED_GLSL

// The first ten bits of a float: its product with a number of fourteen, as places in a map and halves of its size are, is
// exact, and that of the rest is small enough not to be rounded where it counts.
vec4 highPart(vec4 a) { return uintBitsToFloat(floatBitsToUint(a) & 0xffffc000u); }
vec2 highPart(vec2 a) { return uintBitsToFloat(floatBitsToUint(a) & 0xffffc000u); }

// `high` is highPart(a). What the sum loses is found as by [Knuth 1969], and added at the end.
float fused(float a, float high, float b, float c) {
  precise const float product = high * b, rest = (a - high) * b;
  precise const float sum = product + c;
  precise const float cPart = sum - product;
  precise const float lost = (product - (sum - cPart)) + (c - cPart);
  precise const float result = sum + (rest + lost);
  return result;
}

vec4 fused(vec4 a, vec4 high, float b, vec4 c) {
  return vec4(fused(a.x, high.x, b, c.x), fused(a.y, high.y, b, c.y), fused(a.z, high.z, b, c.z),
              fused(a.w, high.w, b, c.w));
}

#endif
