// storage=depth: all maps beside each other in one depth image.
#pragma once

#include "shadow/frame_pipelines.h"
#include "shadow/store.h"

namespace sundial {

class DepthStore : public Store {
 public:
  DepthStore(const Device&, FramePipelines&, const Method&, const shared::FrameConstants&);

  void record(VkCommandBuffer, const DrawView& draw) const override;
  void fit(const shared::Plan&) override;
  void bindTo(BindingSet&) const override;
  std::vector<float> depths() const override;
  std::uint64_t texels() const override;
  std::uint64_t bytes() const override { return texels() * sizeof(float); }

 private:
  void make(VkExtent2D);

  const Device& device_;
  VkPipelineLayout layout_;
  VkPipeline clear_;            // resolution=estimated alone
  std::vector<VkRect2D> maps_;  // where the host knows them
  std::uint64_t texels_;        // of those
  glm::uvec2 viewport_;
  GpuImage image_;
  TexelBuffer unread_;
  Sampler nearest_;
};

}  // namespace sundial
