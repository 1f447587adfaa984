// The six faces of partition=cube: light space turned to each of its axes.
//
// Light space of a light that has a place is (x, y, 1, distance along the axis), so a rotation that takes
// axes to axes permutes x, y and w, and changes their signs. It is its own inverse transposed: points,
// directions and planes turn alike.
#ifndef SUNDIAL_SHARED_CUBE_H
#define SUNDIAL_SHARED_CUBE_H
#include "interop.h"

SUNDIAL_SHARED_BEGIN

SUNDIAL_CONST kCubeFaces = 6u;  // along w, -w, x, -x, y, -y

// From light space before division to the face's.
SUNDIAL_FUNCTION vec4 faceFromLight(uint face, vec4 v) {
  if (face == 1) return vec4(-v.x, v.y, v.z, -v.w);
  if (face == 2) return vec4(-v.w, v.y, v.z, v.x);
  if (face == 3) return vec4(v.w, v.y, v.z, -v.x);
  if (face == 4) return vec4(v.x, -v.w, v.z, v.y);
  if (face == 5) return vec4(v.x, v.w, v.z, -v.y);
  return v;
}

// And back: faces that look the two ways of x, and of y, are each other's inverse.
SUNDIAL_FUNCTION vec4 lightFromFace(uint face, vec4 v) {
  return faceFromLight(face < 2 ? face : face ^ 1u, v);
}

// Turned about the face's axis, so that `axis`, a unit vector, becomes its x axis.
SUNDIAL_FUNCTION vec4 turnedFace(vec4 v, vec2 axis) {
  return vec4(axis.x * v.x + axis.y * v.y, axis.x * v.y - axis.y * v.x, v.z, v.w);
}

SUNDIAL_FUNCTION mat4 faceFromWorld(uint face, vec2 axis, mat4 lightFromWorld) {
  mat4 m;
  for (int column = 0; column < 4; ++column)
    m[column] = turnedFace(faceFromLight(face, lightFromWorld[column]), axis);
  return m;
}

// In whose pyramid a point of light space lies.
SUNDIAL_FUNCTION uint faceOf(vec4 v) {
  const float x = abs(v.x), y = abs(v.y), w = abs(v.w);
  if (w >= x && w >= y) return v.w < 0 ? 1u : 0u;
  if (x >= y) return v.x < 0 ? 3u : 2u;
  return v.y < 0 ? 5u : 4u;
}

SUNDIAL_SHARED_END
#endif
