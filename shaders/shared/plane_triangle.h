// Points, lines and triangles in the plane of a map.
#ifndef SUNDIAL_SHARED_PLANE_TRIANGLE_H
#define SUNDIAL_SHARED_PLANE_TRIANGLE_H
#include "interop.h"

SUNDIAL_SHARED_BEGIN

SUNDIAL_FUNCTION float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// Distance of a point from the line through two others, squared.
SUNDIAL_FUNCTION float lineDistance2(vec2 point, vec2 a, vec2 b) {
  const vec2 along = b - a, to = point - a;
  const float area = cross2(along, to);
  return area * area / max(dot(along, along), 1e-30f);
}

// How far inside of a line from a to b, to its left, times their distance; `margin` is how much nearer to the
// line both may be on each axis.
SUNDIAL_FUNCTION float insideAtLeast(vec2 a, vec2 b, vec2 at, float turn, vec2 margin) {
  const vec2 along = b - a;
  return turn * cross2(along, at - a) - dot(vec2(abs(along.y), abs(along.x)), margin);
}

// Whether a triangle contains the point wherever its corners are within `margin` of where they are said to
// be.
SUNDIAL_FUNCTION bool containsPoint(const vec2 corners[3], vec2 at, vec2 margin) {
  const float turn = cross2(corners[1] - corners[0], corners[2] - corners[0]) >= 0.0f ? 1.0f : -1.0f;
  return insideAtLeast(corners[0], corners[1], at, turn, margin) >= 0.0f &&
         insideAtLeast(corners[1], corners[2], at, turn, margin) >= 0.0f &&
         insideAtLeast(corners[2], corners[0], at, turn, margin) >= 0.0f;
}

SUNDIAL_SHARED_END
#endif
