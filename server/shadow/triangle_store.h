// storage=triangle: 128 bits a texel, packed from what the compute rasteriser found to be nearest.
#pragma once

#include "shadow/linear_store.h"

namespace sundial {

class TriangleStore : public Store {
 public:
  TriangleStore(const Device&, FramePipelines&, const Method&, const shared::FrameConstants&);

  void record(VkCommandBuffer command, const DrawView& draw) const override { ids_.record(command, draw); }
  bool again() override { return ids_.again(); }
  std::vector<Work> work() const override { return ids_.work(); }
  std::string_view filterName() const override { return "pack"; }
  void filter(VkCommandBuffer) const override;
  void fit(const shared::Plan&) override;
  void bindTo(BindingSet&) const override;
  std::vector<float> depths() const override { return ids_.depths(); }
  std::uint64_t texels() const override { return ids_.texels(); }
  std::uint64_t bytes() const override { return ids_.bytes() + packed_.bytes(); }

 private:
  void takeRoom();

  const Device& device_;
  LinearStore ids_;
  VkPipeline pack_;
  GpuImage packed_;  // RGBA32UI: 16 bytes a texel at 4096 x 4096 exceed a buffer's range on lavapipe
  Sampler nearest_;
};

}  // namespace sundial
