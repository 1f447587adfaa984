// storage=linear, storage=depth-id, and raster=compute: maps of any sizes, one behind the other in a buffer,
// drawn by the compute rasteriser.
#pragma once

#include "shadow/rasteriser.h"
#include "shadow/store.h"

namespace sundial {

class LinearStore : public Store {
 public:
  LinearStore(const Device&, FramePipelines&, const Method&, const shared::FrameConstants&);
  // With another choice than the method's.
  LinearStore(const Device&, FramePipelines&, const Method&, const shared::FrameConstants&,
              const RasterChoice&);

  void record(VkCommandBuffer, const DrawView& draw) const override;
  bool again() override;
  std::vector<Work> work() const override;
  void fit(const shared::Plan&) override;
  void bindTo(BindingSet&) const override;
  std::vector<float> depths() const override;
  std::uint64_t texels() const override { return texels_; }
  std::uint64_t bytes() const override { return texels_ * bytesPerTexel_; }

 private:
  const Device& device_;
  bool estimated_;  // the plan knows the maps' sizes, not the host
  std::uint64_t texels_, bytesPerTexel_;
  TexelBuffer maps_;
  Rasteriser rasteriser_;
  GpuImage unread_;
  Sampler nearest_;
};

}  // namespace sundial
