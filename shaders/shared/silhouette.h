// lookup=spsm: the shadow's edge in a texel, from the triangles that it and its neighbours hold
// [Lecocq et al. 2014, section 4.2]. Lengths are texels; depth is greater where it is nearer to the light.
#ifndef SUNDIAL_SHARED_SILHOUETTE_H
#define SUNDIAL_SHARED_SILHOUETTE_H
#include "plane_triangle.h"

SUNDIAL_SHARED_BEGIN

// A triangle as a texel holds it, relative to the texel's centre.
struct TexelTriangle {
  vec2 corners[3];
  float depth;  // of its plane at the centre
  vec2 slope;   // of its plane: depth a texel
};

SUNDIAL_FUNCTION float planeDepth(TexelTriangle t, vec2 at) { return t.depth + dot(t.slope, at); }

// The part of a segment within a box around the origin: shares of its length, the first greater than the
// second where there is none.
SUNDIAL_FUNCTION vec2 clippedToBox(vec2 from, vec2 to, vec2 halfSide) {
  const vec2 along = to - from;
  vec2 part = vec2(0.0f, 1.0f);
  for (int axis = 0; axis < 2; ++axis) {
    if (abs(along[axis]) < 1e-9f) {
      if (abs(from[axis]) > halfSide[axis]) part = vec2(1.0f, 0.0f);
      continue;
    }
    const float a = (-halfSide[axis] - from[axis]) / along[axis],
                b = (halfSide[axis] - from[axis]) / along[axis];
    part = vec2(max(part.x, min(a, b)), min(part.y, max(a, b)));
  }
  return part;
}

// Distance of a segment from the origin.
SUNDIAL_FUNCTION float segmentDistance(vec2 from, vec2 to) {
  const vec2 along = to - from;
  const float share = clamp(-dot(from, along) / max(dot(along, along), 1e-12f), 0.0f, 1.0f);
  const vec2 nearest = from + share * along;
  return sqrt(dot(nearest, nearest));
}

// Where in its texel the triangle is nearest to the light, "consistently": not beyond its own edges. The
// texel's corner in the direction in which its plane comes nearer, if it covers that corner. Or else on an
// edge that keeps it from there, told by a negative barycentric coordinate of that corner, as far towards the
// light as the texel reaches.
SUNDIAL_FUNCTION vec2 nearestPoint(TexelTriangle t) {
  const vec2 corner = vec2(t.slope.x >= 0.0f ? 0.5f : -0.5f, t.slope.y >= 0.0f ? 0.5f : -0.5f);
  const float area = cross2(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
  vec2 best = corner;
  bool found = false, outside = false;
  for (int i = 0; i < 3; ++i) {
    const vec2 from = t.corners[i], to = t.corners[(i + 1) % 3];
    const float barycentric = cross2(to - from, corner - from) * (area >= 0.0f ? 1.0f : -1.0f);
    if (barycentric >= 0.0f) continue;
    outside = true;
    const vec2 part = clippedToBox(from, to, vec2(0.5f));
    if (part.x > part.y) continue;
    const vec2 a = from + part.x * (to - from), b = from + part.y * (to - from);
    const vec2 nearer = dot(t.slope, a) >= dot(t.slope, b) ? a : b;
    if (!found || dot(t.slope, nearer) > dot(t.slope, best)) best = nearer;
    found = true;
  }
  // Rounding can move a triangle that barely touches its texel out of it.
  if (outside && !found) best = clamp(t.corners[0], vec2(-0.5f), vec2(0.5f));
  return best;
}

// The neighbours of a texel, counter-clockwise from the right as bits 0 to 7; y runs down.
SUNDIAL_FUNCTION vec2 neighbourAt(uint i) {
  const float x = i == 0u || i == 1u || i == 7u ? 1.0f : i == 2u || i == 6u ? 0.0f : -1.0f;
  const float y = i == 0u || i == 4u ? 0.0f : i < 4u ? -1.0f : 1.0f;
  return vec2(x, y);
}

// Which way the light lies of a texel's shadow edges: a table over the neighbours that pass for shadowed.
// Bits 0 to 2: how many edges there are, at most four; then 4 bits each: a direction in 16ths of a turn,
// counter-clockwise from the right. Each run of lit neighbours is an edge, seen towards the run's middle. A
// shadowed neighbour at a corner of which neither side is shadowed doesn't belong to the same shadow, and
// counts as lit.
SUNDIAL_FUNCTION uint edgesOfPattern(uint shadowed) {
  uint joined = shadowed;
  for (uint i = 1u; i < 8u; i += 2u)
    if ((shadowed >> (i - 1u) & 1u) == 0u && (shadowed >> ((i + 1u) % 8u) & 1u) == 0u) joined &= ~(1u << i);
  if (joined == 0u || joined == 0xffu) return 0u;
  uint edges = 0u, count = 0u;
  for (uint i = 0u; i < 8u; ++i) {
    // A run begins behind a shadowed neighbour.
    if ((joined >> i & 1u) != 0u || (joined >> ((i + 7u) % 8u) & 1u) == 0u) continue;
    uint length = 1u;
    while ((joined >> ((i + length) % 8u) & 1u) == 0u) ++length;
    edges |= (2u * i + length - 1u) % 16u << (3u + 4u * count);
    ++count;
  }
  return edges | count;
}

// The shadow's edge as a function of the way along a tangent: the lowest of all lines between a point to the
// left and one to the right of the place that is asked for. A point is (way along the tangent, depth into the
// shadow).
struct EdgeFunction {
  vec2 left, right;
  bool hasLeft, hasRight;
};

SUNDIAL_FUNCTION EdgeFunction emptyEdge() {
  EdgeFunction f;
  f.left = vec2(0.0f);
  f.right = vec2(0.0f);
  f.hasLeft = false;
  f.hasRight = false;
  return f;
}

// Takes a point in, relative to the place. Points taken in again may move the function further down: it has
// settled when none does.
SUNDIAL_FUNCTION EdgeFunction with(EdgeFunction f, vec2 point) {
  EdgeFunction g = f;
  if (point.x <= 0.0f) {
    const bool lower = f.hasLeft && f.hasRight ? cross2(f.right - f.left, point - f.left) < 0.0f
                                               : !f.hasLeft || point.y < f.left.y;
    if (lower) g.left = point;
    g.hasLeft = true;
  }
  if (point.x >= 0.0f) {
    const bool lower = g.hasLeft && f.hasRight ? cross2(f.right - g.left, point - g.left) < 0.0f
                                               : !f.hasRight || point.y < f.right.y;
    if (lower) g.right = point;
    g.hasRight = true;
  }
  return g;
}

SUNDIAL_FUNCTION float valueAt(EdgeFunction f, float way) {
  const float width = f.right.x - f.left.x;
  if (width < 1e-6f) return min(f.left.y, f.right.y);
  return f.left.y + (f.right.y - f.left.y) * (way - f.left.x) / width;
}

SUNDIAL_SHARED_END
#endif
