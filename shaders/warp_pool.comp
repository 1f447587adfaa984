#version 460
#extension GL_GOOGLE_include_directive : require
// Counts of a texel and of its neighbours in so many rows (columns, the second time), behind the counts themselves. The
// average of the rows' offset functions, weighted by how many samples each has [NOTW, section 3.1], is the offset function
// of the rows' sum: sum(N o) / sum(N) = sum(g) / sum(N) - x. So the functions are smoothed before they are made.
#include "warp.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kDown = false;

void main() {
  const uint lane = gl_GlobalInvocationID.x;  // a column, or the second time a row
  const uint view = gl_WorkGroupID.z;
  const uvec2 size = warpSize();
  const uint lanes = kDown ? size.y : size.x, length_ = kDown ? size.x : size.y;
  if (lane >= lanes || plan.views[view].empty != 0) return;
  const uint start = kDown ? lane * size.x : lane, step_ = kDown ? 1 : size.x;
  const uint first = importanceAt(view) + start, pooled = gatheredAt(view) + start;
  const uint reach = frame.settings.warpWindow / 2;
  uint sum = 0;
  for (uint i = 0; i < min(reach, length_); ++i) sum += importance[first + i * step_];
  for (uint i = 0; i < length_; ++i) {
    if (i + reach < length_) sum += importance[first + (i + reach) * step_];
    if (i > reach) sum -= importance[first + (i - reach - 1) * step_];
    importance[pooled + i * step_] = sum;
  }
}
