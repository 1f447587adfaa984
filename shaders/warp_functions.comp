#version 460
#extension GL_GOOGLE_include_directive : require
// The warp's functions: running sums of a power of importance, over their last value. A share of each is spread evenly, so that the
// functions rise everywhere and have an inverse.
#include "warp.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kDown = false;

// For a function: of the step from a knot to the next.
float gathered(uint view, uint f, uint k) {
  const uint first = gatheredAt(view), columns = warpSize().x;
  const uint at = kWarp == kWarpNonOrthogonal ? (kDown ? k * columns + f : f * columns + k) : (kDown ? columns : 0) + k;
  return uintBitsToFloat(importance[first + at]);
}

float importanceOf(uint view, uint f, uint k) {
  const float gathered = gathered(view, f, k), power = frame.settings.warpPower;
  return power == 1 ? gathered : power == 0.5 ? sqrt(gathered) : pow(gathered, power);
}

void main() {
  const uint f = gl_GlobalInvocationID.x, view = gl_WorkGroupID.z;
  if (f >= functions(kDown) || plan.views[view].empty != 0) return;
  const uint last = knots(kDown) - 1, table = functionAt(view, f, kDown), rim = warpRim();
  float sum = 0;
  for (uint k = rim; k < last - rim; ++k) {
    const float here = importanceOf(view, f, k);
    warps[table + k] = vec2(sum, here);
    sum += here;
  }
  const float even = sum > 0 ? frame.settings.warpEvenShare : 1;
  const float scale = sum > 0 ? (1 - even) * float(last - 2 * rim) / sum : 0;
  for (uint k = rim; k < last - rim; ++k)
    warps[table + k] = scale * warps[table + k] + even * vec2(k - rim, 1) + vec2(rim, 0);
  for (uint k = 0; k < rim; ++k) {
    warps[table + k] = vec2(k, 1);
    warps[table + last - rim + k] = vec2(last - rim + k, 1);
  }
  warps[table + last] = vec2(last, 0);
}
