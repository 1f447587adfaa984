#include "reference/alpha.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace sundial {

namespace {

// The two texels around a coordinate along one axis, and the weight of the second.
struct Taps {
  int first, second;
  float weight;
};

Taps tapsAround(float coordinate, std::uint32_t size, std::uint32_t wrap) {
  if (!std::isfinite(coordinate)) coordinate = 0;
  // Bring the coordinate near the texture first, without rounding, so that its texel fits an int.
  switch (wrap) {
    case shared::kWrapClamp:
      coordinate = std::clamp(coordinate, 0.0f, 1.0f);
      break;
    case shared::kWrapMirror:
      coordinate -= 2 * std::floor(coordinate * 0.5f);
      break;
    default:
      coordinate -= std::floor(coordinate);
      break;
  }
  const float texel = coordinate * static_cast<float>(size) - 0.5f;
  const float below = std::floor(texel);
  const int n = static_cast<int>(size);
  const auto wrapped = [&](int i) {
    switch (wrap) {
      case shared::kWrapClamp:
        return std::clamp(i, 0, n - 1);
      case shared::kWrapMirror: {
        const int inPeriod = (i + 2 * n) % (2 * n);
        return inPeriod < n ? inPeriod : 2 * n - 1 - inPeriod;
      }
      default:
        return (i + n) % n;
    }
  };
  const int i = static_cast<int>(below);
  return {wrapped(i), wrapped(i + 1), texel - below};
}

float vertexAlpha(const Scene& scene, std::uint32_t vertex) {
  return static_cast<float>(scene.attributes[vertex].colour >> 24) / 255.0f;
}

}  // namespace

float sampleAlpha(const Scene& scene, std::uint32_t layer, glm::vec2 uv, std::uint32_t wrapU,
                  std::uint32_t wrapV) {
  const Taps x = tapsAround(uv.x, scene.textureSize.x, wrapU);
  const Taps y = tapsAround(uv.y, scene.textureSize.y, wrapV);
  const auto& texels = scene.textures[layer];
  const auto alpha = [&](int column, int row) {
    const auto index = static_cast<std::size_t>(row) * scene.textureSize.x + static_cast<std::size_t>(column);
    return static_cast<float>(texels[index].a) / 255.0f;
  };
  const float top = glm::mix(alpha(x.first, y.first), alpha(x.second, y.first), x.weight);
  const float bottom = glm::mix(alpha(x.first, y.second), alpha(x.second, y.second), x.weight);
  return glm::mix(top, bottom, y.weight);
}

AlphaTest::AlphaTest(const Scene& scene) : scene_(scene), meshMasked_(scene.meshes.size()) {
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const auto clusters = std::span(scene.clusters).subspan(mesh.firstCluster, mesh.clusterCount);
    meshMasked_[m] =
        std::ranges::any_of(clusters, [&](const auto& c) { return scene.materials[c.material].masked; });
    if (!meshMasked_[m]) continue;
    material_.resize(scene.indices.size() / 3);
    for (const shared::Cluster& c : clusters)
      std::fill_n(material_.begin() + c.firstIndex / 3, c.indexCount / 3, c.material);
  }
}

bool AlphaTest::isHole(std::uint32_t triangle, float u, float v) const {
  const MaterialInfo& material = scene_.materials[material_[triangle]];
  if (!material.masked) return false;
  const std::uint32_t* corner = &scene_.indices[std::size_t{3} * triangle];
  const float w = 1 - u - v;
  float alpha = material.gpu.baseColour.a;
  alpha *= w * vertexAlpha(scene_, corner[0]) + u * vertexAlpha(scene_, corner[1]) +
           v * vertexAlpha(scene_, corner[2]);
  if (material.gpu.texture != shared::kNoTexture) {
    const auto& attributes = scene_.attributes;
    const glm::vec2 uv =
        w * attributes[corner[0]].uv + u * attributes[corner[1]].uv + v * attributes[corner[2]].uv;
    alpha *= sampleAlpha(scene_, material.gpu.texture, uv, material.gpu.wrapU, material.gpu.wrapV);
  }
  return alpha < material.gpu.alphaCutoff;
}

}  // namespace sundial
