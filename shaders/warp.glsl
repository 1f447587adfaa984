// A view's map re-parameterised: where a point of the map, as the view's matrix puts it there, lies in the warped map, and
// where the centre of a warped texel came from. Creation and lookup use these and nothing else.
//
// Both warps are functions of one coordinate at a time, piecewise linear between the edges of texels. Across:
//   x' = X(x)    and then down: y' = Y(y).
// A rectilinear warp has one X and one Y [Rosen 2012]. A non-orthogonal one has an X for each row and a Y for each column of
// x' [NOTW, equation 6]. Departure: they belong to the middles of rows and columns and are mixed in between, where the paper
// takes the row's that the point lies in: neighbours in the map stay neighbours.
// Positions are in texels, from (0, 0) to the map's size.
#ifndef SUNDIAL_WARP_GLSL
#define SUNDIAL_WARP_GLSL
#include "bindings.glsl"
#include "shared/choices.h"

layout(constant_id = 7) const uint kWarp = kWarpNone;

// How tables lie in the buffer, one behind the other: where texels' centres came from; X's values at the edges of texels,
// function by function; Y's; and bounds of X over groups of functions, least and greatest.
uvec2 warpSize() { return frame.settings.mapSize; }
uint functions(bool down) { return kWarp == kWarpNonOrthogonal ? (down ? warpSize().x : warpSize().y) : 1; }
uint knots(bool down) { return (down ? warpSize().y : warpSize().x) + 1; }

// Groups of 2^level of X's functions, for each level from kFirstLevel on, until one group holds all.
const uint kFirstLevel = 3;
uint groupsOf(uint level) { return (functions(false) + (1u << level) - 1) >> level; }
uint groupsBefore(uint level) {
  uint sum = 0;
  for (uint l = kFirstLevel; l < level; ++l) sum += groupsOf(l);
  return sum;
}
uint lastLevel() {
  uint level = kFirstLevel;
  while (groupsOf(level) > 1) ++level;
  return level;
}

uint centreAt(uvec2 texel) { return 2 * (texel.y * warpSize().x + texel.x); }
uint functionAt(uint f, bool down) {
  return 2 * warpSize().x * warpSize().y + (down ? functions(false) * knots(false) : 0) + f * knots(down);
}
uint boundAt(uint level, uint group, bool greatest) {
  return functionAt(functions(true), true) + (2 * (groupsBefore(level) + group) + (greatest ? 1 : 0)) * knots(false);
}

// The function whose values begin at `table`, at a position.
float valueAt(uint table, float position, uint last) {
  const float at = clamp(position, 0, float(last));
  const uint k = min(uint(at), last - 1);
  return mix(warps[table + k], warps[table + k + 1], at - float(k));
}
// How much longer a step is there after the warp.
float stretchAt(uint table, float position, uint last) {
  const uint k = min(uint(max(position, 0)), last - 1);
  return warps[table + k + 1] - warps[table + k];
}

// The two functions whose rows' or columns' middles are around a position, and the second one's share.
struct Between {
  uint first;
  uint second;
  float share;
};
Between between(float position, bool down) {
  const float at = clamp(position - 0.5, 0, float(functions(down) - 1));
  const uint first = uint(at);
  return Between(functionAt(first, down), functionAt(min(first + 1, functions(down) - 1), down), at - float(first));
}

float warpedAcross(vec2 p) {
  const Between a = between(p.y, false);
  const uint last = warpSize().x;
  return mix(valueAt(a.first, p.x, last), valueAt(a.second, p.x, last), a.share);
}

vec2 warpedPosition(vec2 p) {
  const float x = warpedAcross(p);
  const Between a = between(x, true);
  const uint last = warpSize().y;
  return vec2(x, mix(valueAt(a.first, p.y, last), valueAt(a.second, p.y, last), a.share));
}

vec2 warpStretch(vec2 p) {
  const Between row = between(p.y, false), column = between(warpedAcross(p), true);
  return vec2(mix(stretchAt(row.first, p.x, warpSize().x), stretchAt(row.second, p.x, warpSize().x), row.share),
              mix(stretchAt(column.first, p.y, warpSize().y), stretchAt(column.second, p.y, warpSize().y), column.share));
}

// The inverse at the centre of a warped texel, from the table.
vec2 centreOrigin(uvec2 texel) {
  const uint at = centreAt(texel);
  return vec2(warps[at], warps[at + 1]);
}

#endif
