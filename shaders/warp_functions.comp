#version 460
#extension GL_GOOGLE_include_directive : require
// The warp's functions: running sums of a power of importance, over their last value. A share of each is spread evenly, so that the
// functions rise everywhere and have an inverse.
#include "warp.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kDown = false;

// Of the step from a knot to the next, for a function.
float gatheredAt(uint f, uint k) {
  const uvec2 size = warpSize();
  if (kWarp == kWarpNonOrthogonal)
    return float(importance[size.x * size.y + (kDown ? k * size.x + f : f * size.x + k)]);
  return uintBitsToFloat(importance[size.x + size.y + (kDown ? size.x : 0) + k]);
}

float importanceOf(uint f, uint k) {
  const float gathered = gatheredAt(f, k), power = frame.settings.warpPower;
  return power == 1 ? gathered : power == 0.5 ? sqrt(gathered) : pow(gathered, power);
}

void main() {
  const uint f = gl_GlobalInvocationID.x;
  if (f >= functions(kDown)) return;
  const uint last = knots(kDown) - 1, table = functionAt(f, kDown);
  float sum = 0;
  for (uint k = 0; k < last; ++k) {
    const float here = importanceOf(f, k);
    warps[table + k] = vec2(sum, here);
    sum += here;
  }
  const float even = sum > 0 ? frame.settings.warpEvenShare : 1;
  const float scale = sum > 0 ? (1 - even) * float(last) / sum : 0;
  for (uint k = 0; k < last; ++k) warps[table + k] = scale * warps[table + k] + even * vec2(k, 1);
  warps[table + last] = vec2(last, 0);
}
