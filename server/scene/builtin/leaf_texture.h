// Alpha-tested foliage, painted.
#pragma once

#include "scene/scene_builder.h"

namespace sundial::builtin {

// A single pointed leaf with a midrib, its stalk at the bottom centre (v = 0 is row 0).
Texture leafTexture();
// A twig with a dozen leaves.
Texture twigTexture();

// A double-sided material that is a hole where the texture is transparent.
std::uint32_t addLeafMaterial(SceneBuilder&, std::string name, Texture, const glm::vec3& tint);

}  // namespace sundial::builtin
