// Materials and the images that they use.
#pragma once

#include "scene/gltf/geometry.h"

namespace sundial::gltf {

struct MaterialUse {
  MaterialInfo info;  // gpu.texture: an index into `textures` of the result, or kNoTexture
  TexCoordUse texCoord;
};

struct Materials {
  std::vector<MaterialUse> materials;  // as in the document, then the default material
  std::vector<Texture> textures;
};

// Which materials some triangle has, by index in the document, and whether vertex colours tint them.
struct MaterialDemand {
  bool used = false;
  bool tinted = false;
};

// Loads the images that `demand` (one a material) makes necessary. Errors: those of images, and
// invalidArgument for an alpha mode that glTF doesn't have.
Result<Materials> readMaterials(const Document&, std::span<const MaterialDemand> demand, BufferData&,
                                Budget&);

}  // namespace sundial::gltf
