// A scene on the GPU: buffers, textures, and the list of draws that culling chooses from.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "gpu/pipeline.h"
#include "scene/scene.h"

namespace sundial {

class SceneBuffers {
 public:
  SceneBuffers(const Device&, std::shared_ptr<const Scene>);

  const Scene& scene() const { return *scene_; }
  std::uint32_t drawCount() const { return drawCount_; }  // a multiple of shared::kDrawsPerChunk
  const std::array<glm::uvec2, shared::kBuckets>& buckets() const { return buckets_; }  // first chunk, chunks
  VkDeviceSize bytes() const;

  // Places the instances relative to this origin, if they aren't yet.
  void moveTo(const Device&, const glm::dvec3& origin);
  void bindTo(BindingSet&) const;
  void bindVertices(VkCommandBuffer, bool withAttributes) const;

  static std::vector<VkVertexInputBindingDescription> vertexBindings(bool withAttributes);
  static std::vector<VkVertexInputAttributeDescription> vertexAttributes(bool withTriangle,
                                                                         bool withAttributes);

 private:
  std::shared_ptr<const Scene> scene_;
  Buffer vertices_, attributes_, indices_, clusters_, draws_, instances_, materials_;
  GpuImage textures_;
  Sampler sampler_;
  std::array<glm::uvec2, shared::kBuckets> buckets_{};
  std::uint32_t drawCount_ = 0;
  std::optional<glm::dvec3> origin_;
};

}  // namespace sundial
