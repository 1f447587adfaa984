#include "shadow/warp_maps.h"

#include "gpu/rendering.h"
#include "shared/bindings.h"
#include "shared/samples.h"

namespace sundial {

namespace {

constexpr VkBufferUsageFlags kImportance =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
constexpr VkBufferUsageFlags kTables = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                       VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                       VK_BUFFER_USAGE_TRANSFER_SRC_BIT;

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
  if (warp == Warp::rectilinear) return {w + h + w + 1 + h + 1, 2 * (w + h)};
  return {(h + boundsRows(h)) * (w + 1) + w * (h + 1) + w * h, 2 * w * h};
}

WarpMaps::WarpMaps(const Device& device, FramePipelines& pipelines, const Method& method,
                   const shared::FrameConstants& constants)
    : warp_(method.stages->warp),
      map_(constants.settings.mapSize),
      forward_(warp_ == Warp::rectilinear && method.settings.analysis == Analysis::forward),
      samples_(
          (std::uint64_t{constants.imageSize.x} * constants.imageSize.y + shared::kSamplesPerInvocation - 1) /
          shared::kSamplesPerInvocation),
      pipelines_(pipelines.warp(method)),
      tables_(device, Buffer(device, warpSizesOf(warp_, map_).tables * sizeof(glm::vec2), kTables),
              VK_FORMAT_R32G32_UINT, sizeof(glm::vec2)),
      importance_(device, warpSizesOf(warp_, map_).importance * sizeof(std::uint32_t), kImportance) {}

void WarpMaps::bindTo(BindingSet& bindings) const {
  bindings.set(shared::kBindWarps, tables());
  bindings.set(shared::kBindWarpTexels, tables_);
  bindings.set(shared::kBindImportance, importance_);
}

void WarpMaps::clear(VkCommandBuffer command) const {
  vkCmdFillBuffer(command, importance_, 0, VK_WHOLE_SIZE, 0);
  barrier(command);
}

void WarpMaps::dispatch(VkCommandBuffer command, VkPipeline pipeline, std::uint64_t invocations,
                        std::uint32_t rows) const {
  vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  vkCmdDispatch(command, static_cast<std::uint32_t>((invocations + 63) / 64), rows, 1);
  barrier(command);
}

// Rectilinear.
void WarpMaps::makeFunctions(VkCommandBuffer command) const {
  for (const int down : {0, 1}) {
    dispatch(command, pipelines_.smooth[down], down ? map_.y : map_.x);
    dispatch(command, pipelines_.functions[down], 1);
  }
  dispatch(command, pipelines_.centres, std::max(map_.x, map_.y));
}

void WarpMaps::recordNone(VkCommandBuffer command) const {
  clear(command);
  makeFunctions(command);
}

void WarpMaps::record(VkCommandBuffer command) const {
  clear(command);
  if (warp_ == Warp::rectilinear) {
    dispatch(command, pipelines_.importance, forward_ ? map_.x : samples_, forward_ ? map_.y : 1);
    makeFunctions(command);
    return;
  }
  // Rows, then columns with the rows' warp applied.
  for (const int down : {0, 1}) {
    if (down) clear(command);
    dispatch(command, pipelines_.count[down], samples_);
    dispatch(command, pipelines_.pool[down], down ? map_.y : map_.x);
    dispatch(command, pipelines_.functions[down], down ? map_.x : map_.y);
  }
  dispatch(command, pipelines_.bounds, map_.x + 1);
  dispatch(command, pipelines_.centres, map_.x);
}

}  // namespace sundial
