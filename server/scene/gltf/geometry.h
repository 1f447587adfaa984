// A glTF mesh's primitives as triangles.
#pragma once

#include <glm/glm.hpp>

#include "scene/gltf/accessor.h"
#include "scene/scene_builder.h"

namespace sundial::gltf {

// Which texture coordinates a material reads, and how: uv' = uvFromTexCoord * (uv, 1).
struct TexCoordUse {
  unsigned set = 0;
  glm::mat3 uvFromTexCoord{1};
};

// How many triangles a primitive has, degenerate ones counted; 0 for points and lines, which cast no shadows.
std::uint64_t triangleCount(const tinygltf::Primitive&, const AccessorReader&);

// Lists, strips and fans, indexed or not. `material` stays unset. Errors: as AccessorReader's, and
// invalidArgument for an index out of range or a mode that glTF doesn't have.
Result<Primitive> readPrimitive(const tinygltf::Primitive&, const TexCoordUse&, AccessorReader&);

}  // namespace sundial::gltf
