#include "shadow/placed_clusters.h"

#include <utility>

namespace sundial {

PlacedTriangle PlacedCluster::triangle(std::size_t i) const {
  PlacedTriangle corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = glm::dvec3(worldFromMesh * glm::dvec4(vertices[indices[3 * i + k]].position, 1));
  if (mirrored) std::swap(corners[1], corners[2]);
  return corners;
}

PlacedClusters::PlacedClusters(const SceneBuffers& buffers, const glm::dvec3& origin)
    : scene_(&buffers.scene()), origin_(origin) {
  const std::vector<WorldBox> all = worldBoxes(buffers, origin);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const shared::Draw& draw = buffers.draws()[i];
    if (draw.instance == shared::kNoInstance) continue;
    boxes_.push_back(all[i]);
    draws_.push_back(draw);
  }
}

PlacedCluster PlacedClusters::operator[](std::size_t box) const {
  const shared::Cluster& cluster = scene_->clusters[draws_[box].cluster];
  glm::dmat4 place = scene_->instances[draws_[box].instance].worldFromMesh;
  place[3] -= glm::dvec4(origin_, 0);
  return {.worldFromMesh = place,
          .indices = std::span(scene_->indices).subspan(cluster.firstIndex, cluster.indexCount),
          .vertices = scene_->vertices,
          .doubleSided = scene_->materials[cluster.material].doubleSided,
          .mirrored = glm::determinant(glm::dmat3(place)) < 0};
}

}  // namespace sundial
