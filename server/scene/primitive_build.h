// Everything that SceneBuilder does to one primitive, apart from the others and hence in parallel.
#pragma once

#include "result.h"
#include "scene/scene_builder.h"

namespace sundial {

// Vertex::triangle of a vertex that is no triangle's first.
inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

// A primitive ready to be appended to a scene. Vertices, triangles and clusters count from its own first.
struct BuiltPrimitive {
  std::vector<shared::Vertex> vertices;
  std::vector<shared::Attributes> attributes;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> sourceTriangle;  // index in the primitive, degenerate triangles counted
  std::vector<shared::Cluster> clusters;      // `mesh` unset
  std::uint64_t degenerateTriangles = 0;
};

// Errors: invalidArgument, naming the vertex or index.
Result<BuiltPrimitive> buildPrimitive(const Primitive&);

}  // namespace sundial
