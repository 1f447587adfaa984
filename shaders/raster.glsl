// Triangles on a map's grid, and the texels that they cover: what all dispatches of the compute rasteriser share.
//
// Vertices are rounded to 1/256 texel. From there on coverage is exact, in integers: a texel is covered if its centre
// lies inside all three edges, or on one that is a left or a top edge; conservatively, if its square touches the
// triangle. README.md says which numbers fit into 32 bits, and why.
#ifndef SUNDIAL_RASTER_GLSL
#define SUNDIAL_RASTER_GLSL
#include "material.glsl"
#include "raster_state.glsl"
#include "raster_triangle_id.glsl"

layout(constant_id = 0) const uint kCoverage = kCoverCentre;
layout(constant_id = 1) const bool kMasked = false;

const uint kKind = kMasked ? 1 : 0;

// What becomes of a covered texel: a shader that includes this defines it. `index` counts the store's texels.
void keep(uint index, float depth, uint id);

// A vertex in a view.
struct Corner {
  vec4 clip;
  vec3 attributes;  // of masked triangles: uv, alpha
};

// The same in the view's map.
struct Placed {
  ivec2 grid;  // 1/256 texels from the centre of the map's first texel
  vec2 at;     // texels, before rounding
  float depth;
  vec4 attributes;  // over w, with 1 behind them
};

// The three corners of a triangle of a draw.
void readTriangle(uint view, uint id, out Corner corners[3]) {
  const Draw draw = drawAt(id / kMaxClusterTriangles);
  const Instance place = instanceAt(draw.instance);
  const Triangle triangle = triangleAt(triangleOf(id));
  const mat4 shadowFromWorld = plan.views[view].shadowFromWorld;
  for (int i = 0; i < 3; ++i) {
    corners[i].clip = shadowFromWorld * vec4(placed(place, vertexPosition(triangle.vertices[i])), 1);
    if (kMasked) {
      const Attributes a = vertexAttributes(triangle.vertices[i]);
      corners[i].attributes = vec3(a.uv, unpackUnorm4x8(a.colour).a);
    }
  }
}

// The pipeline's arithmetic, step by step, so that both round to the same place on the grid.
Placed placedIn(Corner corner, uvec2 offset, uvec2 size) {
  precise const float perW = 1 / corner.clip.w;
  precise const vec2 half_ = 0.5 * vec2(size);
  precise const vec2 window = corner.clip.xy * perW * half_ + (vec2(offset) + half_);
  // Where a triangle's plane passes the light, clipping leaves corners that rounding carries far outside.
  precise const vec2 fromCentre = clamp(window, vec2(offset) - 0.5, vec2(offset + size) + 0.5) - 0.5;
  Placed p;
  p.grid = ivec2(roundEven(fromCentre * kSubTexels)) - ivec2(offset * kSubTexels);
  p.at = fromCentre - vec2(offset);
  p.depth = corner.clip.z * perW;
  p.attributes = vec4(corner.attributes, 1) * perW;
  return p;
}

// Texels whose centre, or conservatively whose square, reaches into the box around the triangle.
ivec4 texelBox(Placed p[3], uvec2 size) {
  const ivec2 low = min(min(p[0].grid, p[1].grid), p[2].grid), high = max(max(p[0].grid, p[1].grid), p[2].grid);
  const int reach = kCoverage == kCoverConservative ? int(kSubTexels) / 2 : 0;
  const ivec2 first = (low - reach + int(kSubTexels) - 1) >> 8, last = (high + reach) >> 8;
  return ivec4(max(first, ivec2(0)), min(last, ivec2(size) - 1));
}

bool isEmpty(ivec4 box) { return box.x > box.z || box.y > box.w; }

// Whether one invocation draws it.
bool isSmall(Placed p[3], ivec4 box) {
  const vec2 b = p[1].at - p[0].at, c = p[2].at - p[0].at;
  return all(lessThan(box.zw - box.xy, ivec2(kSmallSide))) && abs(b.x * c.y - b.y * c.x) <= 2.0 * kSmallTexels;
}

// What varies over a triangle as a plane does.
struct Varying {
  ivec2 from;  // the texel at whose centre it has these values
  float depth;
  vec2 depthSlope;
  vec2 depthRange;
  vec4 attributes, attributesRight, attributesDown;
};

Varying varyingOver(Placed p[3], ivec2 from) {
  const vec2 b = p[1].at - p[0].at, c = p[2].at - p[0].at;
  const float area = b.x * c.y - b.y * c.x;
  const float perArea = area != 0 ? 1 / area : 0.0;
  const vec2 depths = vec2(p[1].depth, p[2].depth) - p[0].depth;
  Varying v;
  v.depthSlope = vec2(depths.x * c.y - depths.y * b.y, depths.y * b.x - depths.x * c.x) * perArea;
  const vec2 to = vec2(from) - p[0].at;
  v.from = from;
  v.depth = p[0].depth + dot(v.depthSlope, to);
  v.depthRange = clamp(vec2(min(min(p[0].depth, p[1].depth), p[2].depth), max(max(p[0].depth, p[1].depth), p[2].depth)),
                       0, 1);  // casters before the near plane are kept, at 1
  if (kMasked) {
    const vec4 db = p[1].attributes - p[0].attributes, dc = p[2].attributes - p[0].attributes;
    v.attributesRight = (db * c.y - dc * b.y) * perArea;
    v.attributesDown = (dc * b.x - db * c.x) * perArea;
    v.attributes = p[0].attributes + v.attributesRight * to.x + v.attributesDown * to.y;
  }
  return v;
}

// Its three edges, at one texel and from there on: a texel is covered where all are at least 0.
struct Edges {
  ivec3 at;
  ivec3 right, down;
};

// What an edge counts beyond the centre's side of it: a texel that touches the inside, or nothing on edges to the
// right and at the bottom.
int slack(int right, int down) {
  if (kCoverage == kCoverConservative) return int(kSubTexels) / 2 * (abs(right) + abs(down));
  return right > 0 || (right == 0 && down > 0) ? 0 : -1;
}

// Of a triangle that turns so that its inside is positive, at a texel whose distance to it is short.
Edges edgesNear(ivec2 p[3], ivec2 texel) {
  Edges e;
  for (int i = 0; i < 3; ++i) {
    const ivec2 from = p[i], along = p[(i + 1) % 3] - from, to = texel * int(kSubTexels) - from;
    e.right[i] = -along.y;
    e.down[i] = along.x;
    e.at[i] = (along.x * to.y - along.y * to.x + slack(-along.y, along.x)) >> 8;
  }
  return e;
}

// (a x + b y + c) / 256, rounded down, where it is less than 2^30; the sign alone where it isn't.
int scaledSum(int a, int x, int b, int y, int c) {
  int high, otherHigh, low, otherLow;
  imulExtended(a, x, high, low);
  imulExtended(b, y, otherHigh, otherLow);
  uint carry, carryToo;
  uint sum = uaddCarry(uint(low), uint(otherLow), carry);
  sum = uaddCarry(sum, uint(c), carryToo);
  high += otherHigh + int(carry + carryToo) + (c < 0 ? -1 : 0);
  if (high < -64) return -(1 << 30);
  if (high > 63) return 1 << 30;
  return (high << 24) | int(sum >> 8);
}

// As edgesNear(), at any texel.
Edges edgesFar(ivec2 p[3], ivec2 texel) {
  Edges e;
  for (int i = 0; i < 3; ++i) {
    const ivec2 from = p[i], along = p[(i + 1) % 3] - from, to = texel * int(kSubTexels) - from;
    e.right[i] = -along.y;
    e.down[i] = along.x;
    e.at[i] = scaledSum(along.x, to.y, -along.y, to.x, slack(-along.y, along.x));
  }
  return e;
}

float depthIn(Varying v, ivec2 texel) {
  float depth = v.depth + dot(v.depthSlope, vec2(texel - v.from));
  if (kCoverage == kCoverConservative) depth += 0.5 * (abs(v.depthSlope.x) + abs(v.depthSlope.y));
  return clamp(depth, v.depthRange.x, v.depthRange.y);
}

bool isHoleAt(Varying v, ivec2 texel, uint material) {
  const vec2 to = vec2(texel - v.from);
  const vec4 a = v.attributes + v.attributesRight * to.x + v.attributesDown * to.y;
  return isHole(materials[material], a.xy / a.w, vec4(1, 1, 1, a.z / a.w));
}

// The covered texels of a row, counted from the one that `at` belongs to: [x, y), within [0, texels).
ivec2 spanOf(ivec3 at, ivec3 right, vec3 perRight, int texels) {
  ivec2 span = ivec2(0, texels);
  for (int i = 0; i < 3; ++i) {
    // By a division of floats, which is nearly right, and one step.
    int edge = int(clamp(-float(at[i]) * perRight[i], -1.0, float(texels)));
    if (right[i] > 0) {
      edge += at[i] + right[i] * edge < 0 ? 1 : 0;
      edge += at[i] + right[i] * edge < 0 ? 1 : 0;
      span.x = max(span.x, edge);
    } else if (right[i] < 0) {
      edge += at[i] + right[i] * edge >= 0 ? 1 : 0;
      edge += at[i] + right[i] * edge >= 0 ? 1 : 0;
      span.y = min(span.y, edge);
    } else if (at[i] < 0) {
      span.y = 0;
    }
  }
  return span;
}

void fillTexel(uint view, uint id, uint index, ivec2 texel, Varying v, uint material) {
  if (!(kMasked && isHoleAt(v, texel, material))) keep(index, depthIn(v, texel), id);
}

// Part of a row, counted from a texel.
void fillSpan(uint view, uint id, ivec2 texel, ivec2 span, Varying v, uint material) {
  const uint index =
      plan.views[view].linearOffset + uint(texel.y) * plan.views[view].rectSize.x + uint(texel.x);
  for (int x = span.x; x < span.y; ++x)
    fillTexel(view, id, index + uint(x), ivec2(texel.x + x, texel.y), v, material);
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

// The covered texels of a small box; `e` is at its first. Where an edge crosses a row is followed from row to row by
// quotient and remainder, so that no texel is looked at in vain: what is done to one may be dear, and the other
// invocations of a vector wait for it.
void fill(uint view, uint id, Edges e, Varying v, ivec4 box, uint material) {
  const uint pitch = plan.views[view].rectSize.x;
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

  ivec2 texel = ivec2(0, box.y - 1);
  int end = 0;
  uint row = plan.views[view].linearOffset + uint(texel.y) * pitch + uint(box.x);
  for (;;) {
    if (texel.x >= end) {
      ++texel.y;
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
      texel.x = max(max(first.x, first.y), max(first.z, 0));
      end = min(min(last.x, last.y), min(last.z, width));
    }
    if (texel.y > box.w) break;
    if (texel.x < end) {
      fillTexel(view, id, row + uint(texel.x), ivec2(box.x + texel.x, texel.y), v, material);
      ++texel.x;
    }
  }
}

#endif
