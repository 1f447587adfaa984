// Technique::shadowVolumes: a scene's edges on the device, and the count of volumes that each view sample is
// in.
#pragma once

#include <optional>

#include "gpu/pipeline.h"
#include "scene/scene.h"

namespace sundial {

class FramePipelines;
class SceneBuffers;

// Why volumes can't shadow this scene; nothing if they can.
std::optional<std::string> whyNoVolumes(const Scene&);

// What all frames of a scene share. Built when a frame first asks for volumes.
class EdgeBuffers {
 public:
  EdgeBuffers(const Device&, const SceneBuffers&);

  void bindTo(BindingSet&) const;
  std::uint64_t bytes() const;

  // Draws whose silhouettes are found and drawn together, so that their list is bounded.
  struct Batch {
    std::uint32_t firstDraw, draws;
  };
  const std::vector<Batch>& batches() const { return batches_; }
  std::uint64_t mostEdges() const { return mostEdges_; }  // of a batch

 private:
  TexelBuffer edges_, sides_, ofCluster_, planes_;
  std::vector<Batch> batches_;
  std::uint64_t mostEdges_ = 1;
};

class ShadowVolumes {
 public:
  ShadowVolumes(const Device&, FramePipelines&, const EdgeBuffers&, glm::uvec2 size);

  void bindTo(BindingSet&) const;
  // Draws triangles of the scene with the pipeline that it is given.
  using DrawScene = std::function<void(VkPipeline)>;
  // Counts into the store's image. The set that bindTo() was called for is bound. `drawCaps` draws what the
  // camera sees; `drawEnds` what it would see from the light's place, where the light has one.
  void count(VkCommandBuffer, VkPipelineLayout, const DrawScene& drawCaps, const DrawScene& drawEnds) const;
  std::uint64_t bytes() const { return silhouette_.size() + counts_.bytes(); }

 private:
  const EdgeBuffers& edges_;
  VkPipeline findSilhouette_, sides_, caps_, ends_;
  Buffer silhouette_;
  GpuImage counts_;  // R32F, a pixel each: integers, exact up to 2^24
  Sampler nearest_;
  TexelBuffer unread_;
};

}  // namespace sundial
