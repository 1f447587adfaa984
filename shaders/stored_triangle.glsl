// Which triangle a texel of storage=depth-id holds, and whether it is between a sample and the light.
#ifndef SUNDIAL_STORED_TRIANGLE_GLSL
#define SUNDIAL_STORED_TRIANGLE_GLSL
#include "material.glsl"
#include "raster_triangle_id.glsl"
#include "stored_depth.glsl"

struct StoredTriangle {
  bool exists;  // false where nothing was drawn
  uint instance;
  uint triangle;  // of the scene
};

StoredTriangle storedTriangle(uint view, ivec2 texel) {
  const uvec2 words = texelFetch(linearTexels, int(indexInStore(view, texel))).xy;  // id, depth
  return StoredTriangle(words.y > 0, drawAt(words.x / kMaxClusterTriangles).instance, triangleOf(words.x));
}

// Whether it may have holes.
bool isMasked(StoredTriangle t) { return materials[triangleAt(t.triangle).material].alphaCutoff > 0; }

// Whether the triangle isn't there at the point with these weights of its corners.
bool isHoleAt(Triangle triangle, vec3 weights) {
  const Material material = materials[triangle.material];
  vec3 at = vec3(0);  // uv, alpha
  for (int i = 0; i < 3; ++i) {
    const Attributes a = vertexAttributes(triangle.vertices[i]);
    at += weights[i] * vec3(a.uv, unpackUnorm4x8(a.colour).a);
  }
  return isHole(material, at.xy, vec4(1, 1, 1, at.z));
}

// Whether the sample's ray to the light meets the triangle, beyond the bias in metres and not on the sample's own.
bool isHit(ViewSample s, StoredTriangle t) {
  if (!t.exists || (t.instance == s.instance && t.triangle == s.triangle)) return false;
  const Instance place = instanceAt(t.instance);
  const Triangle triangle = triangleAt(t.triangle);
  const vec3 a = placed(place, vertexPosition(triangle.vertices[0])) - s.wsPosition;
  const vec3 b = placed(place, vertexPosition(triangle.vertices[1])) - s.wsPosition;
  const vec3 c = placed(place, vertexPosition(triangle.vertices[2])) - s.wsPosition;
  const vec3 toLight = wayToLight(s.wsPosition);
  // The ray lies on the inner side of the three planes through the sample and an edge.
  const vec3 volumes = vec3(dot(toLight, cross(b, c)), dot(toLight, cross(c, a)), dot(toLight, cross(a, b)));
  const bool inside = all(greaterThanEqual(volumes, vec3(0))) || all(lessThanEqual(volumes, vec3(0)));
  const vec3 normal = cross(b - a, c - a);
  const float along = dot(normal, toLight);
  const float steps = dot(normal, a) / along;  // of toLight
  if (!inside || along == 0 || steps * length(toLight) <= frame.biasWorld || (!lightIsFar() && steps >= 1)) return false;
  return !isHoleAt(triangle, volumes / (volumes.x + volumes.y + volumes.z));
}

#endif
