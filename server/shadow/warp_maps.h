// The tables of a warp (shaders/warp.glsl), and how they are made from the view samples.
#pragma once

#include "gpu/resource.h"
#include "shadow/frame_pipelines.h"
#include "shadow/method.h"
#include "shared/frame.h"

namespace sundial {

// How many pairs of floats the tables of one map of this size take: its functions with their bounds, and
// where its texels' centres came from, in the place of the importance that all is made from.
struct WarpSizes {
  std::uint64_t functions, centres;
};
WarpSizes warpSizesOf(Warp, const glm::uvec2& map);

// The tables of shaders/warp.glsl, on the host.
struct WarpTables {
  std::vector<glm::vec2> functions, centres;
};

class WarpMaps {
 public:
  WarpMaps(const Device&, FramePipelines&, const Method&, const shared::FrameConstants&);

  void bindTo(BindingSet&) const;
  // Tables of a warp that moves nothing; bindings are bound.
  void recordNone(VkCommandBuffer) const;
  // After the plan, and with an analysis that looks from the light after its map; bindings are bound.
  // Buffers' contents are visible to shaders then.
  void record(VkCommandBuffer) const;
  const Buffer& functions() const { return functions_; }
  const Buffer& centres() const { return centres_; }
  std::uint64_t bytes() const { return functions().size() + centres().size(); }

 private:
  void clear(VkCommandBuffer) const;
  void makeFunctions(VkCommandBuffer) const;
  void dispatch(VkCommandBuffer, VkPipeline, std::uint64_t invocations, std::uint32_t rows,
                std::uint32_t views) const;
  void eachSample(VkCommandBuffer, VkPipeline) const;
  void eachView(VkCommandBuffer, VkPipeline, std::uint64_t invocations) const;

  Warp warp_;
  glm::uvec2 map_;
  bool forward_;           // looks at the light's map instead of the view samples
  std::uint64_t samples_;  // invocations that look at all of those
  std::uint32_t views_;
  WarpPipelines pipelines_;
  TexelBuffer functions_, centres_;
};

}  // namespace sundial
