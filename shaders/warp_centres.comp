#version 460
#extension GL_GOOGLE_include_directive : require
// Where the centres of the warped map's texels came from: the inverse of both functions, y first, because it tells the row
// whose function x has.
#include "warp.glsl"

layout(local_size_x = 64) in;

float mixedAt(Between a, uint knot) { return mix(warps[a.first + knot], warps[a.second + knot], a.share); }

// Of functions that rise, found by halving between two knots.
float inverseOf(Between a, float value, uint low, uint high) {
  while (high - low > 1) {
    const uint middle = (low + high) / 2;
    if (mixedAt(a, middle) <= value) low = middle;
    else high = middle;
  }
  const float before = mixedAt(a, low), after = mixedAt(a, low + 1);
  return float(low) + clamp((value - before) / max(after - before, 1e-30), 0, 1);
}

void main() {
  const uint column = gl_GlobalInvocationID.x;
  const uvec2 size = warpSize();
  if (column >= size.x) return;
  const Between down = between(float(column) + 0.5, true);  // one function: this is a column's middle
  for (uint row = 0; row < size.y; ++row) {
    const float y = inverseOf(down, float(row) + 0.5, 0, size.y);
    const uint at = centreAt(uvec2(column, row));
    warps[at] = inverseOf(between(y, false), float(column) + 0.5, 0, size.x);
    warps[at + 1] = y;
  }
}
