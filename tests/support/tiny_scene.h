// Scenes of a few hand-made meshes, without the builder: each test sees every triangle that it traces.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace sundial::test {

// Three corners a triangle, unshared, so that each triangle's first vertex is its own.
struct Soup {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> uvs;          // empty or one a position
  std::vector<std::uint32_t> colours;  // empty (white) or one a position
};

// A parallelogram: corner, corner + a, corner + a + b, corner + b; uv runs from (0, 0) to (uvMax, uvMax).
inline Soup quad(glm::vec3 corner, glm::vec3 a, glm::vec3 b, float uvMax = 1) {
  const std::array<glm::vec2, 4> unit{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  Soup soup;
  for (std::size_t i : {0, 1, 2, 0, 2, 3}) {
    soup.positions.push_back(corner + a * unit[i].x + b * unit[i].y);
    soup.uvs.push_back(unit[i] * uvMax);
  }
  return soup;
}

// A closed sphere of unit radius around the origin, `rings` from pole to pole and twice as many around.
inline Soup sphere(int rings) {
  const auto at = [&](int ring, int sector) {
    const double theta = std::numbers::pi * ring / rings;
    const double phi = std::numbers::pi * (sector % (2 * rings)) / rings;
    if (ring == 0 || ring == rings) return glm::vec3(0, ring == 0 ? 1 : -1, 0);
    return glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
  };
  Soup soup;
  const auto add = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    soup.positions.insert(soup.positions.end(), {a, b, c});
  };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < 2 * rings; ++s) {
      if (r > 0) add(at(r, s), at(r, s + 1), at(r + 1, s));
      if (r < rings - 1) add(at(r, s + 1), at(r + 1, s + 1), at(r + 1, s));
    }
  return soup;
}

class TinyScene {
 public:
  TinyScene() { scene_.materials.emplace_back().gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}; }

  // A material that is a hole where alpha is below `cutoff`. Material 0 is opaque.
  std::uint32_t addMasked(float alphaFactor, float cutoff, std::uint32_t texture, std::uint32_t wrap) {
    MaterialInfo& material = scene_.materials.emplace_back();
    material.gpu = {glm::vec4(1, 1, 1, alphaFactor), cutoff, texture, wrap, wrap};
    material.masked = true;
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
  }
  // One row of texels a string; '#' is opaque, anything else a hole. All textures have one size.
  std::uint32_t addTexture(const std::vector<std::string>& rows) {
    scene_.textureSize = {rows[0].size(), rows.size()};
    auto& texels = scene_.textures.emplace_back();
    for (const std::string& row : rows)
      for (char c : row) texels.emplace_back(255, 255, 255, c == '#' ? 255 : 0);
    return static_cast<std::uint32_t>(scene_.textures.size() - 1);
  }
  std::uint32_t addMesh(const std::vector<std::pair<Soup, std::uint32_t>>& soupsAndMaterials) {
    Mesh mesh;
    mesh.firstCluster = static_cast<std::uint32_t>(scene_.clusters.size());
    mesh.firstTriangle = triangles();
    for (const auto& [soup, material] : soupsAndMaterials) addClusters(soup, material);
    mesh.clusterCount = static_cast<std::uint32_t>(scene_.clusters.size()) - mesh.firstCluster;
    mesh.triangleCount = triangles() - mesh.firstTriangle;
    scene_.meshes.push_back(mesh);
    return static_cast<std::uint32_t>(scene_.meshes.size() - 1);
  }
  std::uint32_t addMesh(const Soup& soup) { return addMesh({{soup, 0}}); }
  std::uint32_t addInstance(std::uint32_t mesh, const glm::dmat4& worldFromMesh = glm::dmat4(1)) {
    scene_.instances.push_back({worldFromMesh, mesh, ""});
    return static_cast<std::uint32_t>(scene_.instances.size() - 1);
  }
  std::shared_ptr<const Scene> finish() {
    Bounds bounds{glm::dvec3(std::numeric_limits<double>::max()),
                  glm::dvec3(-std::numeric_limits<double>::max())};
    for (const Instance& instance : scene_.instances) {
      const Mesh& mesh = scene_.meshes[instance.mesh];
      for (std::uint32_t i = 3 * mesh.firstTriangle; i < 3 * (mesh.firstTriangle + mesh.triangleCount); ++i) {
        const glm::dvec3 position(scene_.vertices[scene_.indices[i]].position);
        const glm::dvec3 world(instance.worldFromMesh * glm::dvec4(position, 1));
        bounds = {glm::min(bounds.min, world), glm::max(bounds.max, world)};
      }
    }
    scene_.bounds = scene_.instances.empty() ? Bounds{} : bounds;
    return std::make_shared<const Scene>(std::move(scene_));
  }

 private:
  std::uint32_t triangles() const { return static_cast<std::uint32_t>(scene_.indices.size() / 3); }

  void addClusters(const Soup& soup, std::uint32_t material) {
    for (std::uint32_t i = 0; i < soup.positions.size(); ++i) {
      if (i % (3 * shared::kMaxClusterTriangles) == 0)
        scene_.clusters.push_back({glm::vec3(0), 3 * triangles(), glm::vec3(0), 0, material,
                                   static_cast<std::uint32_t>(scene_.meshes.size())});
      ++scene_.clusters.back().indexCount;
      const auto vertex = static_cast<std::uint32_t>(scene_.vertices.size());
      scene_.vertices.push_back({soup.positions[i], vertex / 3});
      scene_.attributes.push_back({soup.uvs.empty() ? glm::vec2(0) : soup.uvs[i],
                                   soup.colours.empty() ? 0xffffffffu : soup.colours[i]});
      scene_.indices.push_back(vertex);
    }
  }

  Scene scene_;
};

}  // namespace sundial::test
