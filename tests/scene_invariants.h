// What every Scene promises (scene/scene.h, shared/scene.h), whoever made it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "scene/scene.h"

namespace sundial {

inline void expectInvariants(const Scene& scene) {
  const std::size_t triangles = scene.sourceTriangle.size();
  ASSERT_EQ(scene.indices.size(), 3 * triangles);
  ASSERT_EQ(scene.attributes.size(), scene.vertices.size());
  for (const std::uint32_t index : scene.indices) ASSERT_LT(index, scene.vertices.size());

  // Each triangle begins with a vertex of its own that carries its index.
  for (std::size_t t = 0; t < triangles; ++t) ASSERT_EQ(scene.vertices[scene.indices[3 * t]].triangle, t);

  // No triangle is degenerate.
  for (std::size_t t = 0; t < triangles; ++t) {
    const glm::dvec3 a(scene.vertices[scene.indices[3 * t]].position);
    const glm::dvec3 b(scene.vertices[scene.indices[3 * t + 1]].position);
    const glm::dvec3 c(scene.vertices[scene.indices[3 * t + 2]].position);
    ASSERT_NE(glm::cross(b - a, c - a), glm::dvec3(0)) << "triangle " << t;
  }

  // Meshes are contiguous runs of clusters, clusters contiguous runs of triangles, in order and without gaps.
  std::uint32_t cluster = 0, triangle = 0;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    ASSERT_EQ(mesh.firstCluster, cluster);
    ASSERT_EQ(mesh.firstTriangle, triangle);
    std::set<std::uint32_t> sources;
    for (std::uint32_t i = 0; i < mesh.clusterCount; ++i, ++cluster) {
      const shared::Cluster& c = scene.clusters[cluster];
      ASSERT_EQ(c.mesh, m);
      ASSERT_LT(c.material, scene.materials.size());
      ASSERT_EQ(c.firstIndex, 3 * triangle);
      ASSERT_GE(c.indexCount, 3u);
      ASSERT_LE(c.indexCount, 3 * shared::kMaxClusterTriangles);
      ASSERT_EQ(c.indexCount % 3, 0u);
      for (std::uint32_t k = 0; k < c.indexCount; ++k) {
        const glm::vec3& p = scene.vertices[scene.indices[c.firstIndex + k]].position;
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(p, c.boundsMin)));
        ASSERT_TRUE(glm::all(glm::lessThanEqual(p, c.boundsMax)));
      }
      ASSERT_TRUE(glm::all(glm::greaterThanEqual(c.boundsMin, mesh.boundsMin)));
      ASSERT_TRUE(glm::all(glm::lessThanEqual(c.boundsMax, mesh.boundsMax)));
      for (std::uint32_t k = 0; k < c.indexCount / 3; ++k, ++triangle)
        ASSERT_TRUE(sources.insert(scene.sourceTriangle[triangle]).second) << "one source for two triangles";
    }
    ASSERT_EQ(mesh.triangleCount, triangle - mesh.firstTriangle);
  }
  ASSERT_EQ(cluster, scene.clusters.size());
  ASSERT_EQ(triangle, triangles);

  for (const auto& texture : scene.textures)
    ASSERT_EQ(texture.size(), std::size_t{scene.textureSize.x} * scene.textureSize.y);
  for (const MaterialInfo& material : scene.materials) {
    ASSERT_TRUE(material.gpu.texture == shared::kNoTexture || material.gpu.texture < scene.textures.size());
    ASSERT_TRUE(material.masked || material.gpu.alphaCutoff == 0);
  }
  for (const Instance& instance : scene.instances) {
    ASSERT_LT(instance.mesh, scene.meshes.size());
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::uint32_t k = 3 * mesh.firstTriangle; k < 3 * (mesh.firstTriangle + mesh.triangleCount); ++k) {
      const glm::dvec3 p(instance.worldFromMesh * glm::dvec4(scene.vertices[scene.indices[k]].position, 1));
      ASSERT_TRUE(glm::all(glm::greaterThanEqual(p, scene.bounds.min - 1e-9 * scene.bounds.diagonal())));
      ASSERT_TRUE(glm::all(glm::lessThanEqual(p, scene.bounds.max + 1e-9 * scene.bounds.diagonal())));
    }
  }
}

// A triangle by where it lies and where it comes from, not by how it is stored: rotated so that the least
// corner comes first.
struct SourceTriangle {
  std::uint32_t mesh = 0, source = 0;
  std::array<std::array<float, 3>, 3> corners{};
  auto operator<=>(const SourceTriangle&) const = default;
};

inline std::vector<SourceTriangle> sourceTriangles(const Scene& scene) {
  std::vector<SourceTriangle> result;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m)
    for (std::uint32_t k = 0; k < scene.meshes[m].triangleCount; ++k) {
      const std::uint32_t t = scene.meshes[m].firstTriangle + k;
      SourceTriangle triangle{m, scene.sourceTriangle[t], {}};
      for (std::size_t c = 0; c < 3; ++c) {
        const glm::vec3& p = scene.vertices[scene.indices[3 * t + c]].position;
        triangle.corners[c] = {p.x, p.y, p.z};
      }
      std::ranges::rotate(triangle.corners, std::ranges::min_element(triangle.corners));
      result.push_back(triangle);
    }
  std::ranges::sort(result);
  return result;
}

}  // namespace sundial
