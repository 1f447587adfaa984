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
#include "view_space.glsl"

layout(constant_id = 7) const uint kWarp = kWarpNone;

// How tables lie in their buffers, a view's behind another's, pairs of floats. Written as `warps`, and read at random as
// `warpTexels`:
//   X at the edges of texels, function by function: its value, and how much longer the step from there is after the warp
//   Y likewise
//   bounds of X over groups of functions, least and greatest
// In the place of the importance that all was made from, and read as `centreTexels`:
//   where texels' centres came from; for a rectilinear warp x column by column, then y row by row
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

uint functionAt(uint view, uint f, bool down) {
  return (kCube ? view * frame.settings.warpEntries : 0) + (down ? functions(false) * knots(false) : 0) + f * knots(down);
}
uint boundAt(uint view, uint level, uint group) {
  return functionAt(view, functions(true), true) + (groupsBefore(level) + group) * knots(false);
}

// Importance has as many entries as there are centres, and behind those of all views as many that are gathered from them.
uint centres() { return kWarp == kWarpNonOrthogonal ? warpSize().x * warpSize().y : warpSize().x + warpSize().y; }
uint importanceAt(uint view) { return kCube ? view * centres() : 0; }
uint gatheredAt(uint view) { return (kCube ? kCubeFaces : 1) * centres() + importanceAt(view); }

// Texels at each side of a map that stay as wide as they are: what lookups see beyond the face that a map is of.
uint warpRim() {
  return kCube ? uint(min(frame.settings.rimTexels, 0.25 * float(min(warpSize().x, warpSize().y)) - 1)) : 0;
}

vec2 warpTexel(uint at) { return uintBitsToFloat(texelFetch(warpTexels, int(at)).xy); }

// The function whose values begin at `table`, at a position, and how much longer a step is there after the warp.
vec2 valueAt(uint table, float position, uint last) {
  const float at = clamp(position, 0, float(last));
  const uint k = min(uint(at), last - 1);
  const vec2 knot = warpTexel(table + k);
  return vec2(knot.x + knot.y * (at - float(k)), knot.y);
}

// The two functions whose rows' or columns' middles are around a position, and the second one's share.
struct Between {
  uint first;
  uint second;
  float share;
};
Between between(uint view, float position, bool down) {
  const float at = clamp(position - 0.5, 0, float(functions(down) - 1));
  const uint first = uint(at), second = min(first + 1, functions(down) - 1);
  return Between(functionAt(view, first, down), functionAt(view, second, down), at - float(first));
}

// What the functions around `beside` make of a position, and its stretch.
vec2 warpedAlong(uint view, float position, float beside, bool down) {
  const uint last = knots(down) - 1;
  if (functions(down) == 1) return valueAt(functionAt(view, 0, down), position, last);
  const Between a = between(view, beside, down);
  return mix(valueAt(a.first, position, last), valueAt(a.second, position, last), a.share);
}

float warpedAcross(uint view, vec2 p) { return warpedAlong(view, p.x, p.y, false).x; }

// Where a position goes, and how much longer steps across and down are there.
vec2 warpedPosition(uint view, vec2 p, out vec2 stretch) {
  const vec2 across = warpedAlong(view, p.x, p.y, false), down = warpedAlong(view, p.y, across.x, true);
  stretch = vec2(across.y, down.y);
  return vec2(across.x, down.x);
}

// The inverse at the centre of a warped texel, from the table.
vec2 centreTexel(uint view, uint at) { return uintBitsToFloat(texelFetch(centreTexels, int(importanceAt(view) + at)).xy); }
vec2 centreOrigin(uint view, uvec2 texel) {
  if (kWarp == kWarpRectilinear)
    return vec2(centreTexel(view, texel.x).x, centreTexel(view, warpSize().x + texel.y).x);
  return centreTexel(view, texel.y * warpSize().x + texel.x);
}

#endif
