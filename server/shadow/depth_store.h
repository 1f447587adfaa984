// storage=depth: all maps beside each other in one depth image.
#pragma once

#include "shadow/store.h"

namespace sundial {

class DepthStore : public Store {
 public:
  DepthStore(const Device&, const Method&, const shared::FrameConstants&);

  void record(VkCommandBuffer, const DrawView& draw) const override;
  void bindTo(BindingSet&) const override;
  std::vector<float> depths() const override;
  std::uint64_t texels() const override { return texels_; }
  std::uint64_t bytes() const override { return texels() * sizeof(float); }

 private:
  const Device& device_;
  std::vector<VkRect2D> maps_;
  std::uint64_t texels_;
  GpuImage image_;
  Buffer unread_;
  Sampler nearest_;
};

}  // namespace sundial
