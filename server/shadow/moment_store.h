// storage=moments: filterable maps, a layer of an image each. The multisampled depth that they are made from
// is one view's at a time [Lauritzen et al. 2011, section 4]. The shaders: moments.glsl says what is stored.
#pragma once

#include "shadow/frame_pipelines.h"
#include "shadow/store.h"

namespace sundial {

// Fills what lookups of moments need, and how far views must reach for them; from the constants of view,
// light and scene.
void settleMoments(shared::FrameConstants&, const Method&);

class MomentStore : public Store {
 public:
  MomentStore(const Device&, FramePipelines&, const Method&, const shared::FrameConstants&);

  void record(VkCommandBuffer, const DrawView& draw) const override;
  std::string_view filterName() const override { return "filter"; }
  void filter(VkCommandBuffer) const override;
  void bindTo(BindingSet&) const override;
  std::uint64_t texels() const override;
  std::uint64_t bytes() const override { return depth_.bytes() + moments_.bytes() + blurred_.bytes(); }

 private:
  void drawFullscreen(VkCommandBuffer, const GpuImage& array, std::uint32_t layer, VkPipeline,
                      std::uint32_t view) const;

  VkPipelineLayout layout_;
  MethodPipelines pipelines_;
  std::uint32_t views_;
  bool blurs_;
  GpuImage depth_, moments_;
  GpuImage blurred_;  // half-way; one texel where nothing blurs
  TexelBuffer unread_;
  Sampler nearest_, level_;
};

}  // namespace sundial
