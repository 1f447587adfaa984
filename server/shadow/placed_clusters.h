// The scene's clusters where a frame finds them: on the host, relative to its origin.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "shadow/host_cull.h"

namespace sundial {

// Corners counter-clockwise seen from the front, metres, relative to the frame's origin.
using PlacedTriangle = std::array<glm::dvec3, 3>;

// One cluster of one instance.
struct PlacedCluster {
  glm::dmat4 worldFromMesh;
  std::span<const std::uint32_t> indices;  // three a triangle
  std::span<const shared::Vertex> vertices;
  bool doubleSided;
  bool mirrored;  // placed so that triangles turn the other way

  std::size_t triangles() const { return indices.size() / 3; }
  PlacedTriangle triangle(std::size_t) const;
};

class PlacedClusters {
 public:
  // Refers to the buffers' scene.
  PlacedClusters(const SceneBuffers&, const glm::dvec3& origin);

  const glm::dvec3& origin() const { return origin_; }
  std::span<const WorldBox> boxes() const { return boxes_; }
  std::span<const shared::Draw> draws() const { return draws_; }  // one a box
  PlacedCluster operator[](std::size_t box) const;                // what lies in that box

 private:
  const Scene* scene_;
  glm::dvec3 origin_;
  std::vector<WorldBox> boxes_;
  std::vector<shared::Draw> draws_;
};

}  // namespace sundial
