// Brings a texture to another size, so that all of a scene's fit into one array.
#pragma once

#include "scene/scene_builder.h"

namespace sundial {

// The common size of textures: the largest side each way, at most kMaxTextureSide.
inline constexpr unsigned kMaxTextureSide = 1024;

// Tent filter as wide as the coarser of the two grids, in linear light, colours weighted by their alpha.
// `from` has texels; `size` is positive.
Texture resizeTexture(const Texture& from, glm::uvec2 size);

}  // namespace sundial
