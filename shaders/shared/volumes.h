// Edges of the scene's meshes, and what of them is a shadow volume's side in this light.
#ifndef SUNDIAL_SHARED_VOLUMES_H
#define SUNDIAL_SHARED_VOLUMES_H
#include "interop.h"

SUNDIAL_SHARED_BEGIN

// An edge and the triangles that it bounds: one, two, or any number. Sides [firstSide, +sideCount) of a list
// in which each is 2 * triangle + (1 where the triangle passes the edge from `to` to `from`).
struct Edge {
  uint from;  // vertices; those of equal position are one
  uint to;
  uint firstSide;
  uint sideCount;
};

// An edge at which more volumes begin than end, or the other way around.
struct SilhouetteEdge {
  uint from;
  uint to;
  uint instance;
  int multiplicity;  // volumes on the left of from-to, seen from the light, less those on the right
};

// VkDrawIndirectCommand, in front of the silhouette's list.
struct SilhouetteDraw {
  uint vertexCount;
  uint instanceCount;
  uint firstVertex;
  uint firstInstance;
};

SUNDIAL_SHARED_END
#endif
