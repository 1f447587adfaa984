// Triangles in a warped map: each texel's centre goes back through the warp's inverse and is tested there, where edges are
// straight. No vertex is moved, so no edge is bent.
//
// Edges are those of homogeneous coordinates [Olano and Greer 1997]: no clipping, whatever lies behind the light.
#ifndef SUNDIAL_RASTER_WARPED_GLSL
#define SUNDIAL_RASTER_WARPED_GLSL
#include "material.glsl"
#include "raster.glsl"
#include "warp.glsl"

// What becomes of a covered texel: keep_depth.glsl.
void keep(uint index, float depth, uint id);

// A listed triangle has an entry for each so many columns of a band.
const uint kColumnsPerEntry = 8, kEntriesPerGroup = 8;
const float kRounding = 1e-2;  // texels

// View, band, and columns, in entries: what maps of 2^14 texels a side have of them.
const uint kViewBits = 8, kBandBits = 11;
uint entryOf(uint view, uint band, uint columns) { return view | (band | columns << kBandBits) << kViewBits; }
void readEntry(uint entry, out uint view, out uint band, out uint column) {
  view = bitfieldExtract(entry, 0, int(kViewBits));
  band = bitfieldExtract(entry, int(kViewBits), int(kBandBits));
  column = (entry >> (kViewBits + kBandBits)) * kColumnsPerEntry;
}

struct WarpedTriangle {
  uint view;
  bool drawn;      // false: it covers nothing
  vec2 low;        // the box around it before the warp, texels
  vec2 high;
  vec2 reference;  // texels before the warp: edges are counted from here
  mat3 edges;      // columns: (a, b, c) with a x + b y + c >= 0 inside
  vec3 slack;      // a thousandth of a texel, so that neighbours leave no gap
  vec3 depths;     // (a, b, c) of the depth
  vec2 depthRange;
  mat3 attributes;  // weights of the corners, over w
};

vec2 boundsOf(uint view, uint level, uint group, float position) {
  const uint at = boundAt(view, level, group), k = min(uint(position), warpSize().x - 1);
  return mix(warpTexel(at + k), warpTexel(at + k + 1), position - float(k));
}

// The columns of the warped map that a box of the map may reach into: between the least value that any of its rows'
// functions has at its left side and the greatest at its right. README.md derives it.
ivec2 warpedColumns(uint view, vec2 low, vec2 high) {
  const uint last = warpSize().x, count = functions(false);
  const uint from = uint(clamp(low.y - 0.5, 0, float(count - 1))), to = min(uint(max(high.y - 0.5, 0)) + 1, count - 1);
  vec2 range = vec2(1e30, -1e30);
  if (to - from < (1u << kFirstLevel)) {
    for (uint f = from; f <= to; ++f) {
      const uint table = functionAt(view, f, false);
      range = vec2(min(range.x, valueAt(table, low.x, last).x), max(range.y, valueAt(table, high.x, last).x));
    }
  } else {
    // Of the first level of which two groups hold the range.
    uint level = kFirstLevel;
    while ((to >> level) > (from >> level) + 1) ++level;
    for (uint group = from >> level; group <= to >> level; ++group)
      range = vec2(min(range.x, boundsOf(view, level, group, low.x).x),
                   max(range.y, boundsOf(view, level, group, high.x).y));
  }
  return ivec2(max(ceil(range.x - 0.5 - kRounding), 0), min(floor(range.y - 0.5 + kRounding), float(last - 1)));
}

// And the rows of one of these columns: its middle has one function.
ivec2 warpedRows(uint view, uint column, vec2 range) {
  const uint last = warpSize().y, table = between(view, float(column) + 0.5, true).first;
  return ivec2(max(ceil(valueAt(table, range.x, last).x - 0.5 - kRounding), 0),
               min(floor(valueAt(table, range.y, last).x - 0.5 + kRounding), float(last - 1)));
}

// A non-orthogonal warp leans: where a column of the map goes depends on the row. So a triangle is taken in bands of rows
// before the warp, in which that changes little. They begin at the middles of rows, where groups of functions do.
const uint kBandLevel = 4;
uint bandOf(float y) { return kWarp == kWarpNonOrthogonal ? uint(max(y - 0.5, 0)) >> kBandLevel : 0; }

vec2 rowsOf(WarpedTriangle t, uint band) {
  vec2 rows = vec2(t.low.y, t.high.y);
  if (band > bandOf(rows.x)) rows.x = float(band << kBandLevel) + 0.5;
  if (band < bandOf(rows.y)) rows.y = float((band + 1) << kBandLevel) + 0.5;
  return rows;
}

// The columns of the warped map that a band of the triangle may reach into: its box's, as far as no edge leaves all of the
// band outside.
ivec2 columnsOf(WarpedTriangle t, uint band) {
  const vec2 rows = rowsOf(t, band), ends = rows - t.reference.y;
  vec2 range = vec2(t.low.x, t.high.x);
  if (kWarp == kWarpNonOrthogonal)
    for (int i = 0; i < 3; ++i) {
      const vec3 edge = t.edges[i];
      const float most = max(edge.y * ends.x, edge.y * ends.y) + edge.z + 2 * t.slack[i];
      if (edge.x > 0) range.x = max(range.x, t.reference.x - most / edge.x);
      if (edge.x < 0) range.y = min(range.y, t.reference.x - most / edge.x);
    }
  return range.x > range.y ? ivec2(0, -1) : warpedColumns(t.view, vec2(range.x, rows.x), vec2(range.y, rows.y));
}

// The rows of the warped map that a band of the triangle may reach into in one of these columns. A rectilinear warp took all
// of a column from one x, where the edges tell the range of y.
ivec2 rowsIn(WarpedTriangle t, uint band, uint column) {
  vec2 range = rowsOf(t, band);
  if (kWarp == kWarpRectilinear) {
    const float x = centreTexel(t.view, column).x - t.reference.x;
    for (int i = 0; i < 3; ++i) {
      const vec3 edge = t.edges[i];
      const float at = edge.x * x + edge.z + 2 * t.slack[i];
      if (edge.y > 0) range.x = max(range.x, t.reference.y - at / edge.y);
      if (edge.y < 0) range.y = min(range.y, t.reference.y - at / edge.y);
    }
  }
  return warpedRows(t.view, column, range);
}

WarpedTriangle warpedTriangle(uint view, Corner corners[3]) {
  WarpedTriangle t;
  t.view = view;
  t.drawn = false;
  // Beyond one side of the map, or behind a spot light.
  bvec4 beyond = bvec4(true);
  bool allBehind = true;
  for (int i = 0; i < 3; ++i) {
    const vec4 clip = corners[i].clip;
    beyond = bvec4(beyond.x && clip.x > clip.w, beyond.y && clip.x < -clip.w, beyond.z && clip.y > clip.w,
                   beyond.w && clip.y < -clip.w);
    allBehind = allBehind && clip.w <= 0;
  }
  if (any(beyond) || allBehind) return t;

  const vec2 size = vec2(warpSize());
  vec3 at[3];  // texels times w, and w
  vec2 low = size, high = vec2(0);
  t.depthRange = vec2(1, 0);
  bool behind = false;
  for (int i = 0; i < 3; ++i) {
    const vec4 clip = corners[i].clip;
    at[i] = vec3(0.5 * (clip.xy + clip.w) * size, clip.w);
    behind = behind || clip.w <= 0;
    if (clip.w <= 0) continue;
    low = min(low, at[i].xy / clip.w);
    high = max(high, at[i].xy / clip.w);
    t.depthRange = vec2(min(t.depthRange.x, clip.z / clip.w), max(t.depthRange.y, clip.z / clip.w));
  }
  if (behind) {
    low = vec2(0);
    high = size;
    t.depthRange = vec2(0, 1);
  }
  if (any(greaterThan(low, size)) || any(lessThan(high, vec2(0)))) return t;
  low = clamp(low, vec2(0), size);
  high = clamp(high, vec2(0), size);
  t.low = low;
  t.high = high;
  if (kWarp == kWarpRectilinear) {
    const ivec2 rows = warpedRows(view, 0, vec2(low.y, high.y));  // the same for all columns
    if (rows.x > rows.y) return t;
  }

  t.reference = low;
  for (int i = 0; i < 3; ++i) at[i].xy -= low * at[i].z;
  mat3 weights = mat3(cross(at[1], at[2]), cross(at[2], at[0]), cross(at[0], at[1]));
  const float volume = dot(at[0], weights[0]);
  if (volume == 0) return t;
  t.edges = volume > 0 ? weights : -weights;
  for (int i = 0; i < 3; ++i) t.slack[i] = 1e-3 * (abs(t.edges[i].x) + abs(t.edges[i].y));
  t.attributes = weights * (1 / volume);
  t.depths = t.attributes * vec3(corners[0].clip.z, corners[1].clip.z, corners[2].clip.z);
  t.drawn = true;
  return t;
}

void keepIfCovered(uint id, WarpedTriangle t, Corner corners[3], uint material, uvec2 texel) {
  const vec3 p = vec3(centreOrigin(t.view, texel) - t.reference, 1);
  if (any(lessThan(p * t.edges + t.slack, vec3(0)))) return;
  if (kMasked) {
    const vec3 perW = p * t.attributes, weights = perW / (perW.x + perW.y + perW.z);
    const vec3 a = weights.x * corners[0].attributes + weights.y * corners[1].attributes + weights.z * corners[2].attributes;
    if (isHole(materials[material], a.xy, vec4(1, 1, 1, a.z))) return;
  }
  const float depth = clamp(clamp(dot(p, t.depths), t.depthRange.x, t.depthRange.y), 0, 1);
  keep(plan.views[t.view].linearOffset + texel.y * warpSize().x + texel.x, depth, id);
}

#endif
