// Filling the texels of a triangle, as one invocation does it.
#ifndef SUNDIAL_RASTER_FILL_GLSL
#define SUNDIAL_RASTER_FILL_GLSL
#include "material.glsl"
#include "raster_edges.glsl"

// What becomes of a covered texel: a shader that includes this defines it. `index` counts the store's texels.
void keep(uint index, float depth, uint id);

// `texel` is counted in the image.
void fillTexel(uint id, uint index, vec2 texel, Varying v, uint material) {
  if (kMasked) {
    // To the pipeline's last bit where there is a pipeline's map to agree with.
    const vec4 a = kCoverage == kCoverCentre
                       ? fused(v.attributes[2], highPart(v.attributes[2]), texel.y,
                               fused(v.attributes[1], highPart(v.attributes[1]), texel.x, v.attributes[0]))
                       : v.attributes[0] + v.attributes[1] * texel.x + v.attributes[2] * texel.y;
    precise const float w = 1 / a.w;
    if (isHole(materials[material], a.xy * w, vec4(1, 1, 1, a.z * w))) return;
  }
  if (kCoverage == kCoverCentre) {
    const float exact = fused(v.depth.z, v.depthHigh.y, texel.y, fused(v.depth.y, v.depthHigh.x, texel.x, v.depth.x));
    // Of what a plane has beyond its triangle, the pipeline clips what lies before the near plane alone.
    keep(index, clamp(exact, 0, 1), id);
    return;
  }
  float depth = clamp(v.depth.x + v.depth.y * texel.x + v.depth.z * texel.y, 0, v.depthAtMost);
  if (kPrefersCovering && v.depthStep > 0) {
    const vec3 inside = clamp(v.inside + v.insideRight * texel.x + v.insideDown * texel.y, 0, 1);
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
  const ivec2 offset = ivec2(plan.views[view].rectOffset);
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
      fillTexel(id, row + uint(x), vec2(offset + ivec2(box.x + x, y)), v, material);
      ++x;
    }
  }
}

void drawSmall(uint view, uint id, Placed p[3], ivec4 box, uint material) {
  ivec2 grid[3] = {p[0].grid, p[1].grid, p[2].grid};
  turnInside(grid, true);
  Varying v = varyingOver(p);
  if (kPrefersCovering) coverOver(v, view, vec2[3](p[0].at - 0.5, p[1].at - 0.5, p[2].at - 0.5));
  fillSmall(view, id, edgesFrom(grid, sidesNear(grid, box.xy * int(kSubTexels))), v, box, material);
}

#endif
