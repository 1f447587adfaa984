// A scene on the GPU: buffers, textures, and the list of draws that culling chooses from.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "gpu/pipeline.h"
#include "scene/scene.h"

namespace sundial {

class SceneBuffers {
 public:
  SceneBuffers(const Device&, std::shared_ptr<const Scene>);

  const Scene& scene() const { return *scene_; }
  // A multiple of shared::kDrawsPerChunk.
  std::uint32_t drawCount() const { return static_cast<std::uint32_t>(drawList_.size()); }
  std::span<const shared::Draw> draws() const { return drawList_; }                     // sorted by bucket
  const std::array<glm::uvec2, shared::kBuckets>& buckets() const { return buckets_; }  // first chunk, chunks
  bool plainColours() const { return plainColours_; }  // no textures, all vertex colours white
  bool hasHoles() const;                               // alpha-tested triangles
  VkDeviceSize bytes() const;

  // Places the instances relative to this origin, if they aren't yet.
  void moveTo(const Device&, const glm::dvec3& origin);
  void bindTo(BindingSet&) const;
  // What lies across triangles' edges (findAdjacent()): found when a frame first asks for it.
  void bindAdjacent(const Device&, BindingSet&) const;
  void bindVertices(VkCommandBuffer, bool withAttributes) const;

  static std::vector<VkVertexInputBindingDescription> vertexBindings(bool withAttributes);
  static std::vector<VkVertexInputAttributeDescription> vertexAttributes(bool withTriangle,
                                                                         bool withAttributes);

 private:
  std::shared_ptr<const Scene> scene_;
  TexelBuffer vertices_, attributes_, triangles_, draws_, instances_;
  Buffer indices_, clusters_, materials_;
  Buffer places_;  // shared::Instance a draw, read as vertex attributes of instance rate
  GpuImage textures_;
  Sampler sampler_;
  std::array<glm::uvec2, shared::kBuckets> buckets_{};
  bool plainColours_;
  std::vector<shared::Draw> drawList_;
  std::optional<glm::dvec3> origin_;
  mutable std::optional<TexelBuffer> adjacent_;
};

}  // namespace sundial
