// Which triangle a texel of storage=depth-id holds, and whether it is between a sample and the light.
#ifndef SUNDIAL_STORED_TRIANGLE_GLSL
#define SUNDIAL_STORED_TRIANGLE_GLSL
#include "raster_triangle_id.glsl"
#include "stored_depth.glsl"

struct StoredTriangle {
  bool exists;  // false where nothing was drawn
  uint draw;
  uint triangle;  // of the scene
};

StoredTriangle storedTriangle(uint view, ivec2 texel) {
  const uint index = 2 * indexInStore(view, texel);
  const uint id = linearStore[index];
  const uint draw = id / kMaxClusterTriangles;
  return StoredTriangle(linearStore[index + 1] > 0, draw, triangleOf(id));
}

// Whether the sample's ray to the light crosses the triangle, farther than the bias and not at the sample's own.
bool isHit(ViewSample s, StoredTriangle t) {
  if (!t.exists) return false;
  const uint instance = drawAt(t.draw).instance;
  if (instance == s.instance && t.triangle == s.triangle) return false;
  const Instance place = instanceAt(instance);
  const Triangle triangle = triangleAt(t.triangle);
  const vec3 a = placed(place, vertexPosition(triangle.vertices[0])) - s.wsPosition;
  const vec3 b = placed(place, vertexPosition(triangle.vertices[1])) - s.wsPosition;
  const vec3 c = placed(place, vertexPosition(triangle.vertices[2])) - s.wsPosition;
  const bool spot = frame.lightKind == kLightSpot;
  const vec3 toLight = spot ? frame.wsLightPosition - s.wsPosition : -frame.wsLightDirection;
  // The ray is on the inner side of three planes through the sample.
  const float u = dot(toLight, cross(b, c)), v = dot(toLight, cross(c, a)), w = dot(toLight, cross(a, b));
  const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  const vec3 normal = cross(b - a, c - a);
  const float along = dot(normal, toLight);
  if (!inside || along == 0) return false;
  const float distance_ = dot(normal, a) / along;  // in units of toLight
  const float reach = length(toLight);
  return distance_ * reach > frame.biasWorld && (!spot || distance_ < 1);
}

#endif
