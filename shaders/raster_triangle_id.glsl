// A triangle of the scene by one number: its draw, and its place in the draw's cluster.
#ifndef SUNDIAL_RASTER_TRIANGLE_ID_GLSL
#define SUNDIAL_RASTER_TRIANGLE_ID_GLSL
#include "bindings.glsl"

uint triangleId(uint draw, uint triangle) { return draw * kMaxClusterTriangles + triangle; }

// Its index in the scene.
uint triangleOf(uint id) {
  return clusters[drawAt(id / kMaxClusterTriangles).cluster].firstIndex / 3 + id % kMaxClusterTriangles;
}

#endif
