// Triangles on a map's grid: what all rounds of the compute rasteriser share.
//
// Vertices are rounded to 1/256 texel. From there on coverage is exact, in integers: a texel is covered if its centre
// lies inside all three edges, or on one that is a left or a top edge; conservatively, if its square touches the
// triangle. server/shadow/README.md says which numbers fit into 32 bits, and why. Maps with a warp have
// raster_warped.glsl.
#ifndef SUNDIAL_RASTER_GLSL
#define SUNDIAL_RASTER_GLSL
#include "bindings.glsl"
#include "fused.glsl"
#include "raster_state.glsl"
#include "raster_triangle_id.glsl"
#include "shared/raster.h"

layout(constant_id = 0) const uint kCoverage = kCoverCentre;
layout(constant_id = 1) const bool kMasked = false;
layout(constant_id = 2) const bool kKeepsId = false;

// Of triangles about as near, which share edges more often than not, a texel keeps the one that covers most of it.
const bool kPrefersCovering = kKeepsId && kCoverage == kCoverConservative;

const uint kKind = kMasked ? 1 : 0;

// A vertex in a view.
struct Corner {
  vec4 clip;
  vec3 attributes;  // of masked triangles: uv, alpha
};

// The same on the view's grid.
struct Placed {
  ivec2 grid;  // 1/256 texels from the centre of the map's first texel
  vec2 at;     // texels of the image from its corner, before rounding
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
  const uvec2 offset = plan.views[view].rectOffset, size = plan.views[view].rectSize;
  precise const float perW = 1 / corner.clip.w;
  precise const vec2 half_ = 0.5 * vec2(size);
  precise const vec2 ndc = corner.clip.xy * perW, centre = vec2(offset) + half_;
  const vec2 high = highPart(ndc);
  const vec2 window = vec2(fused(ndc.x, high.x, half_.x, centre.x), fused(ndc.y, high.y, half_.y, centre.y));
  // Where a triangle's plane passes the light, clipping leaves corners that rounding carries far outside.
  Placed p;
  p.at = clamp(window, vec2(offset) - 0.5, vec2(offset + size) + 0.5);
  precise const vec2 fromCentre = p.at - 0.5;
  p.grid = ivec2(roundEven(fromCentre * kSubTexels)) - ivec2(offset * kSubTexels);
  p.depth = corner.clip.z * perW;
  p.attributes = vec4(corner.attributes, 1) * perW;
  return p;
}

// Texels, first and last, whose centre, or conservatively whose square, can lie in the triangle.
ivec4 texelBox(uint view, Placed p[3]) {
  const ivec2 low = min(min(p[0].grid, p[1].grid), p[2].grid), high = max(max(p[0].grid, p[1].grid), p[2].grid);
  const int reach = kCoverage == kCoverConservative ? int(kSubTexels) / 2 : 0;
  const ivec4 box = ivec4((low - reach + int(kSubTexels) - 1) >> 8, (high + reach) >> 8);
  return ivec4(max(box.xy, ivec2(0)), min(box.zw, ivec2(plan.views[view].rectSize) - 1));
}

bool isEmpty(ivec4 box) { return box.x > box.z || box.y > box.w; }

// Whether one invocation draws it.
bool isSmall(Placed p[3], ivec4 box) {
  const ivec2 texels = box.zw - box.xy + 1;
  const vec2 b = p[1].at - p[0].at, c = p[2].at - p[0].at;
  return all(lessThanEqual(texels, ivec2(kSmallSide))) && abs(b.x * c.y - b.y * c.x) <= 2.0 * kSmallTexels;
}

// What varies over a triangle as a plane does: the value at the centre of the image's first texel, and what each texel to
// the right and down adds. As the pipeline has it, step by step: where alpha is next to its cutoff, or a triangle next to
// edge-on, the last bit decides.
struct Varying {
  vec3 depth;
  vec2 depthHigh;  // highPart() of its slopes
  float depthAtMost;  // conservatively, `depth` is of each texel's corner that is nearest to the light: no nearer than this
  vec4 attributes[3];
  // kPrefersCovering: how much of the texel lies on the inner side of each edge, about, in [0, 1] if clamped.
  vec3 inside, insideRight, insideDown;
  float depthStep;  // depths so far apart count as one
};

Varying varyingOver(Placed p[3]) {
  precise const vec2 d01 = p[0].at - p[1].at, d20 = p[2].at - p[0].at;
  precise const float area = d01.x * d20.y - d01.y * d20.x;
  precise const float perArea = area != 0 ? 1 / area : 0.0;
  precise const vec2 a01 = d01 * perArea, a20 = d20 * perArea, from = p[0].at - 0.5;
  Varying v;
  {
    precise const float z01 = p[0].depth - p[1].depth, z20 = p[2].depth - p[0].depth;
    precise const float right = z01 * a20.y - z20 * a01.y, down = z20 * a01.x - z01 * a20.x;
    precise const float before = right * from.x + down * from.y;
    precise const float first = p[0].depth - before;
    v.depth = vec3(first, right, down);
    v.depthHigh = highPart(v.depth.yz);
  }
  // Casters before the near plane are kept, at 1.
  v.depthAtMost = 1;
  if (kCoverage == kCoverConservative) {
    v.depth.x += 0.5 * (abs(v.depth.y) + abs(v.depth.z));
    v.depthAtMost = clamp(max(max(p[0].depth, p[1].depth), p[2].depth), 0, 1);
  }
  if (kMasked) {
    precise const vec4 t01 = p[0].attributes - p[1].attributes, t20 = p[2].attributes - p[0].attributes;
    precise const vec4 right = t01 * a20.y - t20 * a01.y, down = t20 * a01.x - t01 * a20.x;
    precise const vec4 before = right * from.x + down * from.y;
    precise const vec4 first = p[0].attributes - before;
    v.attributes = vec4[3](first, right, down);
  }
  return v;
}

// What kPrefersCovering asks beyond that; corners are counted from the centre of the image's first texel.
void coverOver(inout Varying v, uint view, vec2 corners[3]) {
  const vec2 b = corners[1] - corners[0], c = corners[2] - corners[0];
  const float turn = b.x * c.y - b.y * c.x >= 0 ? 1.0 : -1.0;
  for (int i = 0; i < 3; ++i) {
    const vec2 along = corners[(i + 1) % 3] - corners[i];
    const vec2 slope = turn * vec2(-along.y, along.x) / max(abs(along.x) + abs(along.y), 1e-6);
    v.inside[i] = 0.5 + dot(slope, -corners[i]);
    v.insideRight[i] = slope.x;
    v.insideDown[i] = slope.y;
  }
  // A texel's width. In the light of a place it is less depth the farther away it is, and counts as it is at the far end.
  const ShadowView s = plan.views[view];
  v.depthStep = max(s.texelSize.x, s.texelSize.y) * (frame.lightKind == kLightDirectional ? 1.0 : s.lsMin.z) /
                (s.lsMax.z - s.lsMin.z);
}

#endif
