// The alpha test of masked materials, as the shaders do it: alpha = base colour's factor * texture * vertex
// colour, and what is below the cutoff is a hole.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace sundial {

// Keeps a reference to the scene.
class AlphaTest {
 public:
  explicit AlphaTest(const Scene&);

  // Whether some triangle of the mesh may have holes.
  bool meshIsMasked(std::uint32_t mesh) const { return meshMasked_[mesh]; }

  // Whether the point (1 - u - v) * v0 + u * v1 + v * v2 of a triangle of a masked mesh is a hole.
  bool isHole(std::uint32_t triangle, float u, float v) const;

 private:
  const Scene& scene_;
  std::vector<bool> meshMasked_;
  std::vector<std::uint32_t> material_;  // per triangle; only meshes that are masked are filled in
};

// Alpha in [0, 1] of a layer of the scene's texture array at `uv`: bilinear between the texels of level 0,
// whose centres lie at +0.5, each wrapped as kWrapRepeat, kWrapClamp or kWrapMirror say.
float sampleAlpha(const Scene&, std::uint32_t layer, glm::vec2 uv, std::uint32_t wrapU, std::uint32_t wrapV);

}  // namespace sundial
