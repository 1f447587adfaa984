// Which side of a triangle's edges texels lie on, exactly.
#ifndef SUNDIAL_RASTER_EDGES_GLSL
#define SUNDIAL_RASTER_EDGES_GLSL
#include "raster.glsl"

// Three edges, at one texel and from there on, in units of texels times 1/256 texels: a texel is covered where all are
// at least 0. Rounding down, when they are found at the one texel, changes no sign, because steps are whole.
struct Edges {
  ivec3 at;
  ivec3 right, down;
};

// What an edge counts beyond the centre's side of it: any texel that touches the inside; or nothing, on edges at the
// right and at the bottom.
int slack(ivec2 along) {
  if (kCoverage == kCoverConservative) return int(kSubTexels) / 2 * (abs(along.x) + abs(along.y));
  return along.y < 0 || (along.y == 0 && along.x > 0) ? 0 : -1;
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

// At a place of the grid that is near the triangle, as the triangle is small.
ivec3 sidesNear(ivec2 p[3], ivec2 place) {
  ivec3 sides;
  for (int i = 0; i < 3; ++i) {
    const ivec2 along = p[(i + 1) % 3] - p[i], to = place - p[i];
    sides[i] = (along.x * to.y - along.y * to.x + slack(along)) >> 8;
  }
  return sides;
}

// The same anywhere.
ivec3 sidesFar(ivec2 p[3], ivec2 place) {
  ivec3 sides;
  for (int i = 0; i < 3; ++i) {
    const ivec2 along = p[(i + 1) % 3] - p[i], to = place - p[i];
    sides[i] = scaledSum(along.x, to.y, -along.y, to.x, slack(along));
  }
  return sides;
}

Edges edgesFrom(ivec2 p[3], ivec3 at) {
  const ivec2 a = p[1] - p[0], b = p[2] - p[1], c = p[0] - p[2];
  return Edges(at, -ivec3(a.y, b.y, c.y), ivec3(a.x, b.x, c.x));
}

// Corners on the grid, in the order in which the inside of all edges is positive.
void turnInside(inout ivec2 p[3], bool small) {
  const ivec2 b = p[1] - p[0], c = p[2] - p[0];
  const int twiceArea = small ? b.x * c.y - b.y * c.x : scaledSum(b.x, c.y, -b.y, c.x, 0);
  if (twiceArea >= 0) return;
  const ivec2 second = p[1];
  p[1] = p[2];
  p[2] = second;
}

#endif
