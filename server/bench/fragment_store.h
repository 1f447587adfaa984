// Maps in one linear buffer as the paper draws them: by the graphics pipeline, each fragment keeping the
// nearest depth by an atomic [Alecu 2014, listing 3.1]. Measured here beside the compute rasteriser, which
// frames use.
#pragma once

#include "shadow/frame_pipelines.h"
#include "shadow/store.h"

namespace sundial::bench {

class FragmentStore final : public Store {
 public:
  // `conservative`: every texel that a triangle touches, grown by a geometry shader; opaque triangles in
  // parallel light alone.
  FragmentStore(const Device&, const FramePipelines&, const Method&, bool conservative = false);

  void record(VkCommandBuffer, const DrawView& draw) const override;
  std::optional<std::array<VkPipeline, 2>> pipelines() const override {
    return std::array<VkPipeline, 2>{opaque_, masked_};
  }
  void bindTo(BindingSet&) const override;
  std::vector<float> depths() const override;
  std::uint64_t texels() const override { return texels_; }
  std::uint64_t bytes() const override { return texels_ * sizeof(float); }

 private:
  const Device& device_;
  std::vector<VkRect2D> maps_;
  std::uint64_t texels_;
  TexelBuffer depths_;
  GpuImage unread_;
  Sampler nearest_;
  Pipeline opaque_, masked_;
};

}  // namespace sundial::bench
