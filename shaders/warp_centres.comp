#version 460
#extension GL_GOOGLE_include_directive : require
// Where the centres of the warped map's texels came from: the inverse of both functions, y first, because it tells the row
// whose function x has.
#include "warp.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = kBindImportance, scalar) buffer CentreBlock { vec2 origins[]; };

float mixedAt(Between a, uint knot) {
  const float value = warpTexel(a.first + knot).x;
  return a.share == 0 ? value : mix(value, warpTexel(a.second + knot).x, a.share);
}

// Of functions that rise, found by halving between two knots, from `near` on if it lies next to that one.
float inverseOf(Between a, float value, uint last, inout uint near) {
  const uint kReach = 4;
  uint low = near - min(near, kReach), high = min(near + kReach, last);
  if (mixedAt(a, low) > value) low = 0;
  if (mixedAt(a, high) <= value) high = last;
  while (high - low > 1) {
    const uint middle = (low + high) / 2;
    if (mixedAt(a, middle) <= value) low = middle;
    else high = middle;
  }
  near = low;
  const float before = mixedAt(a, low), after = mixedAt(a, low + 1);
  return float(low) + clamp((value - before) / max(after - before, 1e-30), 0, 1);
}

void main() {
  const uint column = gl_GlobalInvocationID.x, view = gl_WorkGroupID.z;
  if (plan.views[view].empty != 0) return;
  const uint first = importanceAt(view);
  const uvec2 size = warpSize();
  const float middle = float(column) + 0.5;
  uvec2 near = uvec2(0);
  if (kWarp == kWarpRectilinear) {  // here also a row
    if (column < size.x) origins[first + column].x = inverseOf(between(view, 0, false), middle, size.x, near.x);
    if (column < size.y) origins[first + size.x + column].x = inverseOf(between(view, 0, true), middle, size.y, near.y);
    return;
  }
  if (column >= size.x) return;
  const Between down = between(view, middle, true);  // one function: this is a column's middle
  for (uint row = 0; row < size.y; ++row) {
    const float y = inverseOf(down, float(row) + 0.5, size.y, near.y);
    origins[first + row * size.x + column] = vec2(inverseOf(between(view, y, false), middle, size.x, near.x), y);
  }
}
