#version 460
#extension GL_GOOGLE_include_directive : require
// warp=rectilinear: the most of a column or row, smoothed over its neighbours [Rosen 2012], behind what it is made from. A
// pass of its own because lavapipe ends an invocation after 65,535 rounds of its loops.
#include "warp.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kDown = false;

void main() {
  const uint k = gl_GlobalInvocationID.x, view = gl_WorkGroupID.z;
  const uint start = kDown ? warpSize().x : 0, first = importanceAt(view) + start;
  const uint length_ = kDown ? warpSize().y : warpSize().x, reach = frame.settings.warpWindow / 2;
  if (k >= length_ || plan.views[view].empty != 0) return;
  float sum = 0, weights = 0;
  for (uint i = k - min(k, reach); i <= min(k + reach, length_ - 1); ++i) {
    const float weight = float(reach + 1) - abs(float(i) - float(k));
    sum += weight * uintBitsToFloat(importance[first + i]);
    weights += weight;
  }
  importance[gatheredAt(view) + start + k] = floatBitsToUint(sum / weights);
}
