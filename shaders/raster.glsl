// Triangles on a map's grid: what all rounds of the compute rasteriser share.
//
// Vertices are rounded to 1/256 texel. From there on coverage is exact, in integers: a texel is covered if its centre
// lies inside all three edges, or on one that is a left or a top edge; conservatively, if its square touches the
// triangle, which is asked of maps without a warp alone. server/shadow/README.md says which numbers fit into 32 bits,
// and why.
#ifndef SUNDIAL_RASTER_GLSL
#define SUNDIAL_RASTER_GLSL
#include "raster_map.glsl"
#include "raster_state.glsl"
#include "raster_triangle_id.glsl"

layout(constant_id = 0) const uint kCoverage = kCoverCentre;
layout(constant_id = 1) const bool kMasked = false;

const uint kKind = kMasked ? 1 : 0;

// A vertex in a view.
struct Corner {
  vec4 clip;
  vec3 attributes;  // of masked triangles: uv, alpha
};

// The same on the view's grid.
struct Placed {
  ivec2 grid;  // 1/256 texels from the centre of the map's first texel
  vec2 at;     // texels, before rounding
  float depth;
  vec4 attributes;  // over w, with 1 behind them
};

void readTriangle(uint view, uint id, out Corner corners[3]) {
  const Instance place = instanceAt(drawAt(id / kMaxClusterTriangles).instance);
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

// Of a masked triangle.
uint materialOf(uint id) { return kMasked ? clusters[drawAt(id / kMaxClusterTriangles).cluster].material : 0; }

// The pipeline's arithmetic, step by step, so that both round to the same place on the grid.
Placed placedIn(uint view, Corner corner) {
  const uvec2 offset = isWarped() ? uvec2(0) : plan.views[view].rectOffset, size = linearSize(view);
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

// Texels, first and last, whose centre, or conservatively whose square, can lie in the triangle.
ivec4 texelBox(uint view, Placed p[3]) {
  const ivec2 low = min(min(p[0].grid, p[1].grid), p[2].grid), high = max(max(p[0].grid, p[1].grid), p[2].grid);
  const int reach = kCoverage == kCoverConservative ? int(kSubTexels) / 2 : 0;
  ivec4 box = ivec4((low - reach + int(kSubTexels) - 1) >> 8, (high + reach) >> 8);
  if (isWarped()) box = warpedBox(view, ivec4(low, high));
  return ivec4(max(box.xy, ivec2(0)), min(box.zw, ivec2(plan.views[view].rectSize) - 1));
}

bool isEmpty(ivec4 box) { return box.x > box.z || box.y > box.w; }

// Whether one invocation draws it.
bool isSmall(Placed p[3], ivec4 box) {
  const ivec2 texels = box.zw - box.xy + 1;
  const vec2 b = p[1].at - p[0].at, c = p[2].at - p[0].at;
  if (!isWarped())
    return all(lessThanEqual(texels, ivec2(kSmallSide))) && abs(b.x * c.y - b.y * c.x) <= 2.0 * kSmallTexels;
  // Every texel of the box is looked at.
  const vec2 reach = max(abs(b), abs(c));
  return all(lessThan(reach, vec2(kSmallSide / 2))) && all(lessThanEqual(texels, ivec2(kSmallTexels))) &&
         texels.x * texels.y <= int(kSmallTexels);
}

// What varies over a triangle as a plane does.
struct Varying {
  vec2 from;  // texels of the view without a warp, from the centre of the first: where it has these values
  float depth;
  vec2 depthSlope;
  vec2 depthRange;
  vec4 attributes, attributesRight, attributesDown;
  // With conservative coverage: how much of the texel lies on the inner side of each edge, about, in [0, 1] if clamped.
  vec3 inside, insideRight, insideDown;
  float depthStep;  // depths so far apart count as one
};

Varying varyingOver(Placed p[3], ivec2 from) {
  const vec2 b = p[1].at - p[0].at, c = p[2].at - p[0].at, to = vec2(from) - p[0].at;
  const float area = b.x * c.y - b.y * c.x;
  const float perArea = area != 0 ? 1 / area : 0.0;
  const vec2 depths = vec2(p[1].depth, p[2].depth) - p[0].depth;
  Varying v;
  v.from = vec2(from);
  v.depthSlope = vec2(depths.x * c.y - depths.y * b.y, depths.y * b.x - depths.x * c.x) * perArea;
  v.depth = p[0].depth + dot(v.depthSlope, to);
  // Casters before the near plane are kept, at 1.
  v.depthRange =
      clamp(vec2(min(min(p[0].depth, p[1].depth), p[2].depth), max(max(p[0].depth, p[1].depth), p[2].depth)), 0, 1);
  if (kMasked) {
    const vec4 db = p[1].attributes - p[0].attributes, dc = p[2].attributes - p[0].attributes;
    v.attributesRight = (db * c.y - dc * b.y) * perArea;
    v.attributesDown = (dc * b.x - db * c.x) * perArea;
    v.attributes = p[0].attributes + v.attributesRight * to.x + v.attributesDown * to.y;
  }
  return v;
}

// What conservative coverage asks beyond that; corners are counted as `from` is.
void coverOver(inout Varying v, uint view, vec2 corners[3]) {
  const vec2 b = corners[1] - corners[0], c = corners[2] - corners[0];
  const float turn = b.x * c.y - b.y * c.x >= 0 ? 1.0 : -1.0;
  for (int i = 0; i < 3; ++i) {
    const vec2 along = corners[(i + 1) % 3] - corners[i];
    const vec2 slope = turn * vec2(-along.y, along.x) / max(abs(along.x) + abs(along.y), 1e-6);
    v.inside[i] = 0.5 + dot(slope, v.from - corners[i]);
    v.insideRight[i] = slope.x;
    v.insideDown[i] = slope.y;
  }
  // A texel's width; a spot light's shrinks with the distance from the light, and counts as it is at the far end.
  const ShadowView s = plan.views[view];
  v.depthStep = max(s.texelSize.x, s.texelSize.y) * (frame.lightKind == kLightSpot ? s.lsMin.z : 1.0) /
                (s.lsMax.z - s.lsMin.z);
}

#endif
