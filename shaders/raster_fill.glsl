// Filling the texels of a triangle, as one invocation does it.
#ifndef SUNDIAL_RASTER_FILL_GLSL
#define SUNDIAL_RASTER_FILL_GLSL
#include "material.glsl"
#include "raster_edges.glsl"

// What becomes of a covered texel: a shader that includes this defines it. `index` counts the store's texels.
void keep(uint index, float depth, uint id);

// `place` is counted as Varying's `from` is.
void fillTexel(uint id, uint index, vec2 place, Varying v, uint material) {
  const vec2 to = place - v.from;
  if (kMasked) {
    const vec4 a = v.attributes + v.attributesRight * to.x + v.attributesDown * to.y;
    if (isHole(materials[material], a.xy / a.w, vec4(1, 1, 1, a.z / a.w))) return;
  }
  float depth = v.depth + dot(v.depthSlope, to);
  if (kCoverage == kCoverConservative) depth += 0.5 * (abs(v.depthSlope.x) + abs(v.depthSlope.y));
  depth = clamp(depth, v.depthRange.x, v.depthRange.y);
  // Of triangles about as near, which share edges more often than not, the one that covers most of the texel.
  if (kCoverage == kCoverConservative && v.depthStep > 0) {
    const vec3 inside = clamp(v.inside + v.insideRight * to.x + v.insideDown * to.y, 0, 1);
    depth = min((floor(depth / v.depthStep) + inside.x * inside.y * inside.z) * v.depthStep, 1.0);
  }
  keep(index, depth, id);
}

uint indexOf(uint view, ivec2 texel) {
  return plan.views[view].linearOffset + uint(texel.y) * plan.views[view].rectSize.x + uint(texel.x);
}

// Floor and remainder of a division by a positive number, of numbers that floats hold exactly.
void divide(ivec3 a, ivec3 b, vec3 perB, out ivec3 quotient, out ivec3 remainder) {
  quotient = ivec3(floor(vec3(a) * perB));
  remainder = a - quotient * b;
  const ivec3 under = ivec3(lessThan(remainder, ivec3(0)));
  quotient -= under;
  remainder += under * b;
  const ivec3 over = ivec3(greaterThanEqual(remainder, b));
  quotient += over;
  remainder -= over * b;
}

// The covered texels of a box; `e` is at its first. Where an edge crosses a row is followed from row to row by quotient
// and remainder, so that no texel is looked at in vain: what is done to one may be dear, and the other invocations of a
// vector wait for it.
void fillSmall(uint view, uint id, Edges e, Varying v, ivec4 box, uint material) {
  const int width = box.z - box.x + 1;
  const ivec3 right = max(abs(e.right), 1);
  const vec3 perRight = 1 / vec3(right);
  // In steps to the right: where the edge is crossed before the first texel, and what a row adds.
  ivec3 crossing, part, step_, stepPart;
  divide(e.at, right, perRight, crossing, part);
  divide(e.down, right, perRight, step_, stepPart);
  crossing -= step_;
  part -= stepPart;
  const bvec3 opens = greaterThan(e.right, ivec3(0)), closes = lessThan(e.right, ivec3(0));

  const uint pitch = plan.views[view].rectSize.x;
  uint row = indexOf(view, box.xy) - pitch;
  int x = 0, end = 0, y = box.y - 1;
  for (;;) {
    if (x >= end) {
      ++y;
      row += pitch;
      crossing += step_;
      part += stepPart;
      const ivec3 over = ivec3(greaterThanEqual(part, right));
      crossing += over;
      part -= over * right;
      const ivec3 first = mix(ivec3(0), -crossing, opens);
      // An edge along the row lets all of it in, or nothing.
      const ivec3 along = mix(ivec3(width), ivec3(0), lessThan(crossing, ivec3(0)));
      const ivec3 last = mix(mix(along, crossing + 1, closes), ivec3(width), opens);
      x = max(max(first.x, first.y), max(first.z, 0));
      end = min(min(last.x, last.y), min(last.z, width));
    }
    if (y > box.w) break;
    if (x < end) {
      fillTexel(id, row + uint(x), vec2(box.x + x, y), v, material);
      ++x;
    }
  }
}

// The same of a warped map.
void fillWarped(uint view, uint id, ivec2 p[3], Varying v, ivec4 box, uint material) {
  const ivec2 low = min(min(p[0], p[1]), p[2]), high = max(max(p[0], p[1]), p[2]);
  for (int y = box.y; y <= box.w; ++y)
    for (int x = box.x; x <= box.z; ++x) {
      const ivec2 place = linearOf(view, ivec2(x, y));
      if (any(lessThan(place, low)) || any(greaterThan(place, high))) continue;
      if (all(greaterThanEqual(sidesNear(p, place), ivec3(0))))
        fillTexel(id, indexOf(view, ivec2(x, y)), vec2(place) / kSubTexels, v, material);
    }
}

void drawSmall(uint view, uint id, Placed p[3], ivec4 box, uint material) {
  ivec2 grid[3] = {p[0].grid, p[1].grid, p[2].grid};
  turnInside(grid, true);
  if (isWarped()) {
    fillWarped(view, id, grid, varyingOver(p, grid[0] >> 8), box, material);
    return;
  }
  Varying v = varyingOver(p, box.xy);
  if (kCoverage == kCoverConservative) coverOver(v, view, vec2[3](p[0].at, p[1].at, p[2].at));
  fillSmall(view, id, edgesFrom(grid, sidesNear(grid, box.xy * int(kSubTexels))), v, box, material);
}

#endif
