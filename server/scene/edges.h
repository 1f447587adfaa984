// The edges of a scene's meshes, with all triangles about each: what silhouettes are found from, and how one
// gets from triangle to triangle.
#pragma once

#include "scene/scene.h"
#include "shared/volumes.h"

namespace sundial {

struct SceneEdges {
  std::vector<shared::Edge> edges;    // sorted by cluster
  std::vector<std::uint32_t> sides;   // see shared::Edge
  std::vector<glm::uvec2> ofCluster;  // first edge and number of edges of each cluster
  std::vector<glm::vec4> planes;      // of each triangle, mesh space: dot(xyz, p) + w is positive on the
                                      // side from which its corners run counter-clockwise
};

// An edge belongs to the cluster of one of its triangles; of vertices in one place one stands for all. Edges
// of different meshes are different edges.
SceneEdges findEdges(const Scene&);

// Three a triangle of the scene, of its edges from corner 0 to 1, from 1 to 2 and from 2 to 0: what lies
// across the edge, by shared::adjacentSide(). Of several triangles about an edge it is the next one, in a
// circle; across a rim a triangle meets itself. At most 2^29 triangles.
std::vector<std::uint32_t> findAdjacent(const Scene&);

}  // namespace sundial
