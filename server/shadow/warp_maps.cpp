#include "shadow/warp_maps.h"

#include "gpu/rendering.h"
#include "shadow/plan_settings.h"
#include "shared/bindings.h"
#include "shared/samples.h"

namespace sundial {

namespace {

constexpr VkBufferUsageFlags kTables = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                       VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                       VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

TexelBuffer makeTables(const Device& device, std::uint64_t pairs) {
  return {device, Buffer(device, pairs * sizeof(glm::vec2), kTables), VK_FORMAT_R32G32_UINT,
          sizeof(glm::vec2)};
}

// A row of bounds for each group of 8, 16, ... functions, until one group holds all: warp.glsl.
std::uint64_t boundsRows(std::uint64_t functions) {
  std::uint64_t rows = 0;
  for (unsigned level = 3;; ++level) {
    const std::uint64_t groups = (functions + (1u << level) - 1) >> level;
    rows += groups;
    if (groups <= 1) return rows;
  }
}

}  // namespace

WarpSizes warpSizesOf(Warp warp, const glm::uvec2& map) {
  const std::uint64_t w = map.x, h = map.y;
  if (warp == Warp::none) return {0, 0};
  if (warp == Warp::rectilinear) return {w + 1 + h + 1, w + h};
  return {(h + boundsRows(h)) * (w + 1) + w * (h + 1), w * h};
}

WarpMaps::WarpMaps(const Device& device, FramePipelines& pipelines, const Method& method,
                   const shared::FrameConstants& constants)
    : warp_(method.stages->warp),
      map_(constants.settings.mapSize),
      forward_(warp_ == Warp::rectilinear && method.settings.analysis == Analysis::forward),
      samples_(
          (std::uint64_t{constants.imageSize.x} * constants.imageSize.y + shared::kSamplesPerInvocation - 1) /
          shared::kSamplesPerInvocation),
      views_(shadowViewsOf(method)),
      pipelines_(pipelines.warp(method)),
      functions_(makeTables(device, views_ * warpSizesOf(warp_, map_).functions)),
      centres_(makeTables(device, views_ * warpSizesOf(warp_, map_).centres)) {}

void WarpMaps::bindTo(BindingSet& bindings) const {
  bindings.set(shared::kBindWarps, functions());
  bindings.set(shared::kBindWarpTexels, functions_);
  bindings.set(shared::kBindImportance, centres());
  bindings.set(shared::kBindCentreTexels, centres_);
}

// What is gathered from importance, behind it, is written anew.
void WarpMaps::clear(VkCommandBuffer command) const {
  vkCmdFillBuffer(command, centres(), 0, centres().size() / 2, 0);
  barrier(command);
}

void WarpMaps::dispatch(VkCommandBuffer command, VkPipeline pipeline, std::uint64_t invocations,
                        std::uint32_t rows, std::uint32_t views) const {
  vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  vkCmdDispatch(command, static_cast<std::uint32_t>((invocations + 63) / 64), rows, views);
  barrier(command);
}

void WarpMaps::eachSample(VkCommandBuffer command, VkPipeline pipeline) const {
  dispatch(command, pipeline, samples_, 1, 1);
}

void WarpMaps::eachView(VkCommandBuffer command, VkPipeline pipeline, std::uint64_t invocations) const {
  dispatch(command, pipeline, invocations, 1, views_);
}

// Rectilinear.
void WarpMaps::makeFunctions(VkCommandBuffer command) const {
  for (const int down : {0, 1}) {
    eachView(command, pipelines_.smooth[down], down ? map_.y : map_.x);
    eachView(command, pipelines_.functions[down], 1);
  }
  eachView(command, pipelines_.centres, std::max(map_.x, map_.y));
}

void WarpMaps::recordNone(VkCommandBuffer command) const {
  clear(command);
  makeFunctions(command);
}

void WarpMaps::record(VkCommandBuffer command) const {
  clear(command);
  if (warp_ == Warp::rectilinear) {
    if (forward_)
      dispatch(command, pipelines_.importance, map_.x, map_.y, views_);
    else
      eachSample(command, pipelines_.importance);
    makeFunctions(command);
    return;
  }
  // Rows, then columns with the rows' warp applied.
  for (const int down : {0, 1}) {
    if (down) clear(command);
    eachSample(command, pipelines_.count[down]);
    eachView(command, pipelines_.pool[down], down ? map_.y : map_.x);
    eachView(command, pipelines_.functions[down], down ? map_.x : map_.y);
  }
  eachView(command, pipelines_.bounds, map_.x + 1);
  eachView(command, pipelines_.centres, map_.x);
}

}  // namespace sundial
