// The node hierarchy, flattened.
#pragma once

#include <glm/glm.hpp>

#include "scene/gltf/document.h"
#include "scene/view.h"

namespace sundial::gltf {

struct MeshInstance {
  std::string name;
  std::size_t mesh = 0;
  glm::dmat4 worldFromMesh{1};
};

struct Placed {
  std::vector<MeshInstance> instances;
  std::vector<NamedView> views;    // perspective cameras; names are unique
  std::vector<NamedLight> lights;  // KHR_lights_punctual; names are unique
};

// What the default scene holds (the first one where none is named, all root nodes where there is none).
// Errors: invalidArgument for nodes that are no tree, a transform that is not affine, a camera or light out
// of its ranges; resourceExhausted for more than `maxInstances`.
Result<Placed> placeNodes(const tinygltf::Model&, std::uint64_t maxInstances);

}  // namespace sundial::gltf
