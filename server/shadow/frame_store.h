// The memory that holds a frame's shadow maps, and where each view's map lies in it.
#pragma once

#include <functional>
#include <optional>

#include "gpu/pipeline.h"
#include "shadow/method.h"
#include "shared/frame.h"

namespace sundial {

// Why this device can't hold the method's maps; nothing if it can, or if the method has none.
std::optional<std::string> whyTooLarge(const Method&, const Device&);

class FrameStore {
 public:
  // Of a method with a map; `constants` are settled (plan_settings.h).
  FrameStore(const Device&, const Method&, const shared::FrameConstants&);

  // Clears all maps, and calls `draw` for each view with viewport and scissor set to its map.
  void record(VkCommandBuffer, const std::function<void(std::uint32_t view)>& draw) const;
  void bindTo(BindingSet&) const;

  std::uint64_t texels() const { return texels_; }
  std::uint64_t bytes() const { return texels_ * sizeof(float); }

 private:
  std::vector<VkRect2D> maps_;  // of each view; in a linear buffer each begins at 0, 0
  std::uint64_t texels_;
  GpuImage image_;  // storage=depth, or one texel
  Buffer linear_;   // storage=linear, or nothing
  bool isLinear_;
  Sampler nearest_;
};

}  // namespace sundial
