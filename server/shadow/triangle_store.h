// storage=triangle: 128 bits a texel, packed from what the compute rasteriser found to be nearest: of the
// texels that the samples' lookups will read, because packing them all takes longer than all else.
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
  void gather(VkCommandBuffer, std::uint32_t samples) const override;
  void gatherMore(VkCommandBuffer) const override;
  void fit(const shared::Plan&) override;
  void bindTo(BindingSet&) const override;
  std::vector<float> depths() const override { return ids_.depths(); }
  std::uint64_t texels() const override { return ids_.texels(); }
  std::uint64_t bytes() const override;

 private:
  void takeRoom();
  void pack(VkCommandBuffer) const;

  const Device& device_;
  LinearStore ids_;
  VkPipeline want_ = VK_NULL_HANDLE;  // none: all texels are packed
  std::uint32_t moreReach_;
  VkPipeline pack_;
  // RGBA32UI, seen as texels alone: 16 bytes of 4096 x 4096 exceed a storage buffer's range on lavapipe.
  TexelBuffer packed_;
  Buffer wanted_;  // shared::WantedTexels
};

}  // namespace sundial
