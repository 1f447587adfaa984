#version 460
#extension GL_GOOGLE_include_directive : require
// Counts of a texel and of its neighbours in so many rows (columns, the second time), behind the counts themselves. The
// average of the rows' offset functions, weighted by how many samples each has [NOTW, section 3.1], is the offset function
// of the rows' sum: sum(N o) / sum(N) = sum(g) / sum(N) - x. So the functions are smoothed before they are made.
// Departure: a row weighs less the farther away it is, too, down to nothing at the window's ends. Where all weigh the same a
// row that enters the window or leaves it is a step, from one function to the next, in all texels beside it.
#include "warp.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kDown = false;

// Sums of 64 bits, which hold every sample of a row times every window.
void add(inout uvec2 sum, uvec2 part) {
  uint carry;
  sum.x = uaddCarry(sum.x, part.x, carry);
  sum.y += part.y + carry;
}
void take(inout uvec2 sum, uint part) {
  uint borrow;
  sum.x = usubBorrow(sum.x, part, borrow);
  sum.y -= borrow;
}
uvec2 product(uint a, uint b) {
  uvec2 both;
  umulExtended(a, b, both.y, both.x);
  return both;
}

void main() {
  const uint lane = gl_GlobalInvocationID.x;  // a column, or the second time a row
  const uint view = gl_WorkGroupID.z;
  const uvec2 size = warpSize();
  const uint lanes = kDown ? size.y : size.x, length_ = kDown ? size.x : size.y;
  if (lane >= lanes || plan.views[view].empty != 0) return;
  const uint start = kDown ? lane * size.x : lane, step_ = kDown ? 1 : size.x;
  const uint first = importanceAt(view) + start, pooled = gatheredAt(view) + start;
  // Of a count that is n away, reach + 1 - n. From one texel to the next the weights of what is ahead within reach rise by one, and
  // those of what is behind fall by one.
  const uint reach = frame.settings.warpWindow / 2, within = min(reach, length_ - 1);
  uint ahead = 0, behind = 0;
  uvec2 sum = uvec2(0);
  for (uint i = 0; i <= within; ++i) {
    ahead += importance[first + i * step_];
    add(sum, uvec2(ahead, 0));
  }
  add(sum, product(ahead, reach - within));
  for (uint i = 0; i < length_; ++i) {
    importance[pooled + i * step_] = floatBitsToUint(4294967296.0 * float(sum.y) + float(sum.x));
    const uint here = importance[first + i * step_];
    ahead -= here;
    behind += here;
    if (i + reach + 1 < length_) ahead += importance[first + (i + reach + 1) * step_];
    if (i > reach) behind -= importance[first + (i - reach - 1) * step_];
    add(sum, uvec2(ahead, 0));
    take(sum, behind);
  }
}
