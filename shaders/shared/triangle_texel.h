// storage=triangle: what a texel keeps of the triangle that is nearest to the light in it, in 128 bits
// [Lecocq et al. 2014, sections 3.3 and 3.4]: its corners on the map, 3 x 2 x 16 bits; its depth at the
// texel's centre, 16 bits; and how depth changes along the map, 2 x 8 bits.
#ifndef SUNDIAL_SHARED_TRIANGLE_TEXEL_H
#define SUNDIAL_SHARED_TRIANGLE_TEXEL_H
#include "plane_triangle.h"

SUNDIAL_SHARED_BEGIN

// Corners are kept on a grid that reaches this far beyond the map on each side, in shares of the map.
SUNDIAL_CONST_FLOAT kCornerMargin = 0.125f;
SUNDIAL_CONST_FLOAT kCornerSteps = 65535.0f;
// Code 0 is a texel without a triangle, the last one a triangle before the near plane: nearer than all that
// asks.
SUNDIAL_CONST_FLOAT kDepthSteps = 65533.0f;
SUNDIAL_CONST kDepthBefore = 65535u;
SUNDIAL_CONST_FLOAT kBefore = 2.0f;  // its depth
SUNDIAL_CONST kSlopeCodes = 256u;
SUNDIAL_CONST_FLOAT kHalfPi = 1.57079632679f;

// A triangle on a map: x and y in [0, 1] across the map, depth in [0, 1], greater is nearer to the light.
struct MapTriangle {
  vec2 corners[3];
  float depth;  // of its plane at the texel's centre
  vec2 slope;   // of its plane: depth a map's side to the right and down
};

// How a view's depth and slopes are measured before they become codes: in the world's proportions, whatever
// the map's are. A tile of a deep scene, or the reciprocal of distance, would leave all slopes next to the
// code of none.
struct TexelMetric {
  vec2 side;        // of the map, light space
  float near, far;  // light space's depth where the map's is 1 and 0
  bool reciprocal;  // it is that of distance, of which codes then keep the same share anywhere
};

SUNDIAL_FUNCTION float lsDepthOf(float depth, TexelMetric m) { return m.far + depth * (m.near - m.far); }

// The map's depth that codes begin with, of light that has no farthest place.
SUNDIAL_CONST_FLOAT kLeastReciprocal = 1e-4f;

SUNDIAL_FUNCTION float farthestOf(TexelMetric m) { return max(m.far, kLeastReciprocal * m.near); }

// In [0, 1], as codes are spread over it.
SUNDIAL_FUNCTION float shareOfDepth(float depth, TexelMetric m) {
  if (!m.reciprocal) return depth;
  const float farthest = farthestOf(m);
  return log(max(lsDepthOf(depth, m), farthest) / farthest) / log(m.near / farthest);
}

SUNDIAL_FUNCTION float depthOfShare(float share, TexelMetric m) {
  if (!m.reciprocal) return share;
  const float farthest = farthestOf(m);
  return (farthest * exp(share * log(m.near / farthest)) - m.far) / (m.near - m.far);
}

// By how much depth of the map a step of the share is more than one of depth.
SUNDIAL_FUNCTION float depthPerShare(float depth, TexelMetric m) {
  return m.reciprocal ? lsDepthOf(depth, m) * log(m.near / farthestOf(m)) / (m.near - m.far) : 1.0f;
}

// Depth over a side of the map where a plane leans by 45 degrees.
SUNDIAL_FUNCTION vec2 slopePerTangent(float depth, TexelMetric m) {
  return m.side * ((m.reciprocal ? lsDepthOf(depth, m) : 1.0f) / (m.near - m.far));
}

// Equation 3: of all angles between depth and map, those near a right angle get the most codes.
SUNDIAL_FUNCTION uint codeOfSlope(float slope) {
  const float x = atan(slope) / kHalfPi;
  // The outermost two codes would be planes through the light's ray, without a slope.
  return uint(clamp(floor(127.0f * (1.0f + x * x * x * x * x) + 0.5f), 1.0f, 253.0f));
}

// Equation 4, in the table that decodes.
SUNDIAL_FUNCTION float slopeOfCode(float code) {
  const float x = clamp(code, 0.5f, 253.5f) / 127.0f - 1.0f;
  return tan(kHalfPi * sign(x) * pow(abs(x), 0.2f));
}

SUNDIAL_FUNCTION uint codeOfCorner(vec2 corner) {
  const vec2 share = (corner + kCornerMargin) / (1.0f + 2.0f * kCornerMargin);
  const vec2 code = floor(clamp(share, vec2(0.0f), vec2(1.0f)) * kCornerSteps + 0.5f);
  return uint(code.x) | uint(code.y) << 16;
}

SUNDIAL_FUNCTION vec2 cornerOfCode(uint code) {
  const vec2 share = vec2(float(code & 0xffffu), float(code >> 16)) / kCornerSteps;
  return share * (1.0f + 2.0f * kCornerMargin) - kCornerMargin;
}

SUNDIAL_FUNCTION uint codeOfDepth(float depth, TexelMetric m) {
  if (depth > 1.0f) return kDepthBefore;
  return 1u + uint(floor(clamp(shareOfDepth(max(depth, 0.0f), m), 0.0f, 1.0f) * kDepthSteps + 0.5f));
}

SUNDIAL_FUNCTION float depthOfCode(uint code, TexelMetric m) {
  return code == kDepthBefore ? kBefore : depthOfShare((float(code) - 1.0f) / kDepthSteps, m);
}

// How far along from-to the grid begins, for a corner beyond it: 2 where the edge passes the grid by.
SUNDIAL_FUNCTION float shareToGrid(vec2 from, vec2 to) {
  const vec2 low = vec2(-kCornerMargin), high = vec2(1.0f + kCornerMargin);
  const vec2 target = clamp(from, low, high), along = to - from;
  float share = 0.0f;
  if (target.x != from.x) share = max(share, along.x != 0.0f ? (target.x - from.x) / along.x : 2.0f);
  if (target.y != from.y) share = max(share, along.y != 0.0f ? (target.y - from.y) / along.y : 2.0f);
  if (!(share >= 0.0f && share <= 1.0f)) return 2.0f;
  const vec2 at = from + share * along, rounding = vec2(1e-4f);
  return at.x >= low.x - rounding.x && at.y >= low.y - rounding.y && at.x <= high.x + rounding.x &&
                 at.y <= high.y + rounding.y
             ? share
             : 2.0f;
}

SUNDIAL_FUNCTION bool isOnGrid(vec2 corner) {
  return abs(corner.x - 0.5f) <= 0.5f + kCornerMargin && abs(corner.y - 0.5f) <= 0.5f + kCornerMargin;
}

// Where a corner beyond the grid is kept if another corner is on it: moved along one of its two edges to the
// grid's rim, the one that passes nearer to the texel. That edge stays where it is; what is cut off lies at
// the other one.
SUNDIAL_FUNCTION vec2 cornerOnGrid(vec2 corner, vec2 next, vec2 other, vec2 texelCentre) {
  if (isOnGrid(corner)) return corner;
  const bool nextIsNearer =
      lineDistance2(texelCentre, corner, next) <= lineDistance2(texelCentre, corner, other);
  const vec2 first = nextIsNearer ? next : other, second = nextIsNearer ? other : next;
  const float alongFirst = shareToGrid(corner, first);
  if (alongFirst <= 1.0f) return corner + alongFirst * (first - corner);
  const float alongSecond = shareToGrid(corner, second);
  if (alongSecond <= 1.0f) return corner + alongSecond * (second - corner);
  return clamp(corner, vec2(-kCornerMargin), vec2(1.0f + kCornerMargin));
}

// How far from a place on the map a ray reaches the grid's rim.
SUNDIAL_FUNCTION float wayToRim(vec2 place, vec2 direction) {
  const vec2 room = 0.5f + kCornerMargin - (place - 0.5f) * sign(direction);
  return min(room.x / max(abs(direction.x), 1e-9f), room.y / max(abs(direction.y), 1e-9f));
}

// How far from a place inside of a line through a and b a ray reaches it; far where it never does.
SUNDIAL_FUNCTION float wayToLine(vec2 place, vec2 direction, vec2 a, vec2 b) {
  const vec2 along = b - a, to = a - place;
  const float across = direction.x * along.y - direction.y * along.x;
  const float way = abs(across) > 1e-12f ? (to.x * along.y - to.y * along.x) / across : -1.0f;
  return way > 0.0f ? way : 1e9f;
}

// A triangle as one on the grid that is the same about the texel if no more than one edge passes through it:
// on its nearest edge, from rim to rim, and as high over the texel as there is room. Where no edge crosses
// the grid it covers all, and one about the texel does as well.
SUNDIAL_FUNCTION MapTriangle grownAbout(MapTriangle t, vec2 texelCentre) {
  int nearest = 0;
  for (int i = 1; i < 3; ++i)
    if (lineDistance2(texelCentre, t.corners[i], t.corners[(i + 1) % 3]) <
        lineDistance2(texelCentre, t.corners[nearest], t.corners[(nearest + 1) % 3]))
      nearest = i;
  const vec2 a = t.corners[nearest], b = t.corners[(nearest + 1) % 3], c = t.corners[(nearest + 2) % 3];
  const float fromA = shareToGrid(a, b), fromB = shareToGrid(b, a);
  MapTriangle grown = t;
  const bool isFar = lineDistance2(texelCentre, a, b) > 0.8f * kCornerMargin * kCornerMargin;
  if (isFar || fromA > 1.0f || fromB > 1.0f) {
    grown.corners[0] = texelCentre + kCornerMargin * vec2(-1.0f, -1.0f);
    grown.corners[1] = texelCentre + kCornerMargin * vec2(1.0f, -1.0f);
    grown.corners[2] = texelCentre + kCornerMargin * vec2(0.0f, 1.0f);
    return grown;
  }
  const vec2 along = b - a, toC = c - a;
  const float turn = along.x * toC.y - along.y * toC.x >= 0.0f ? 1.0f : -1.0f;
  const vec2 inwards = turn * vec2(-along.y, along.x) / sqrt(max(dot(along, along), 1e-30f));
  const float height = min(wayToRim(texelCentre, inwards),
                           min(wayToLine(texelCentre, inwards, b, c), wayToLine(texelCentre, inwards, c, a)));
  grown.corners[0] = a + fromA * along;
  grown.corners[1] = b - fromB * along;
  grown.corners[2] = texelCentre + height * inwards;
  return grown;
}

// Its corners beyond the grid moved to the rim.
SUNDIAL_FUNCTION MapTriangle cutToGrid(MapTriangle t, vec2 texelCentre) {
  MapTriangle moved = t;
  moved.corners[0] = cornerOnGrid(t.corners[0], t.corners[1], t.corners[2], texelCentre);
  moved.corners[1] = cornerOnGrid(t.corners[1], t.corners[2], t.corners[0], texelCentre);
  moved.corners[2] = cornerOnGrid(t.corners[2], t.corners[0], t.corners[1], texelCentre);
  return moved;
}

// Whether a cut took a corner of the square about the texel away from the triangle.
SUNDIAL_FUNCTION bool isCutOff(MapTriangle given, MapTriangle cut, vec2 texelCentre, vec2 halfSquare) {
  const vec2 rounding = -0.05f * halfSquare;
  for (int i = 0; i < 4; ++i) {
    const vec2 place = texelCentre + halfSquare * vec2(i % 2 == 0 ? -1.0f : 1.0f, i < 2 ? -1.0f : 1.0f);
    if (containsPoint(given.corners, place, vec2(0.0f)) && !containsPoint(cut.corners, place, rounding))
      return true;
  }
  return false;
}

// A triangle as one whose corners are on the grid, and that is the same in a square about the texel.
SUNDIAL_FUNCTION MapTriangle onGrid(MapTriangle given, vec2 texelCentre, vec2 halfSquare) {
  if (isOnGrid(given.corners[0]) || isOnGrid(given.corners[1]) || isOnGrid(given.corners[2])) {
    const MapTriangle cut = cutToGrid(given, texelCentre);
    if (!isCutOff(given, cut, texelCentre, halfSquare)) return cut;
  }
  return cutToGrid(grownAbout(given, texelCentre), texelCentre);
}

// Of a triangle on the grid.
SUNDIAL_FUNCTION uvec4 packedTriangle(MapTriangle t, TexelMetric m) {
  const vec2 slope = t.depth > 1.0f ? vec2(0.0f) : t.slope / slopePerTangent(max(t.depth, 0.0f), m);
  return uvec4(codeOfCorner(t.corners[0]), codeOfCorner(t.corners[1]), codeOfCorner(t.corners[2]),
               codeOfDepth(t.depth, m) << 16 | codeOfSlope(slope.x) << 8 | codeOfSlope(slope.y));
}

SUNDIAL_SHARED_END
#endif
