// The tables of a warp (shaders/warp.glsl), and how they are made from the view samples.
#pragma once

#include "gpu/resource.h"
#include "shadow/frame_pipelines.h"
#include "shadow/method.h"
#include "shared/frame.h"

namespace sundial {

// How many entries a warp of maps of this size takes: pairs of floats of its tables, and integers of
// importance.
struct WarpSizes {
  std::uint64_t tables, importance;
};
WarpSizes warpSizesOf(Warp, const glm::uvec2& map);

class WarpMaps {
 public:
  WarpMaps(const Device&, FramePipelines&, const Method&, const shared::FrameConstants&);

  void bindTo(BindingSet&) const;
  // Tables of a warp that moves nothing; bindings are bound.
  void recordNone(VkCommandBuffer) const;
  // After the plan, and with an analysis that looks from the light after its map; bindings are bound.
  // Buffers' contents are visible to shaders then.
  void record(VkCommandBuffer) const;
  const Buffer& tables() const { return tables_; }
  std::uint64_t bytes() const { return tables().size() + importance_.size(); }

 private:
  void clear(VkCommandBuffer) const;
  void makeFunctions(VkCommandBuffer) const;
  void dispatch(VkCommandBuffer, VkPipeline, std::uint64_t invocations, std::uint32_t rows = 1) const;

  Warp warp_;
  glm::uvec2 map_;
  bool forward_;           // looks at the light's map instead of the view samples
  std::uint64_t samples_;  // invocations that look at all of those
  WarpPipelines pipelines_;
  TexelBuffer tables_;
  Buffer importance_;
};

}  // namespace sundial
