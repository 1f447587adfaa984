// storage=linear: maps of any sizes, one behind the other in a buffer. Fragments keep the nearest depth by
// atomics.
#pragma once

#include "shadow/store.h"

namespace sundial {

class LinearStore : public Store {
 public:
  LinearStore(const Device&, const Method&);

  void record(VkCommandBuffer, const DrawView& draw) const override;
  void bindTo(BindingSet&) const override;
  std::uint64_t texels() const override { return texels_; }
  std::uint64_t bytes() const override { return texels() * sizeof(float); }

 private:
  std::vector<VkRect2D> maps_;
  std::uint64_t texels_;
  Buffer depths_;
  GpuImage unread_;
  Sampler nearest_;
};

}  // namespace sundial
