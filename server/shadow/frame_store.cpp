#include "shadow/frame_store.h"

#include <fmt/format.h>

#include <algorithm>

#include "gpu/rendering.h"
#include "shadow/plan_settings.h"
#include "shared/bindings.h"

namespace sundial {

namespace {

std::vector<VkRect2D> mapsOf(const Method& method, const shared::FrameConstants& constants) {
  std::vector<VkRect2D> maps;
  const bool linear = method.stages->storage == Storage::linear;
  for (std::uint32_t view = 0; view < shadowViewsOf(method); ++view) {
    const shared::PlanSettings& settings = constants.settings;
    glm::uvec2 size = settings.mapSize;
    if (method.stages->partition == Partition::tiles) size = glm::uvec2(settings.tileTexels[view]);
    const glm::uvec2 place =
        linear ? glm::uvec2(0) : size * glm::uvec2(view % settings.mapColumns, view / settings.mapColumns);
    maps.push_back({{static_cast<std::int32_t>(place.x), static_cast<std::int32_t>(place.y)}, {size.x, size.y}});
  }
  return maps;
}

std::uint64_t texelsOf(const std::vector<VkRect2D>& maps) {
  std::uint64_t texels = 0;
  for (const VkRect2D& map : maps) texels += std::uint64_t{map.extent.width} * map.extent.height;
  return texels;
}

}  // namespace

std::optional<std::string> whyTooLarge(const Method& method, const Device& device) {
  if (!method.stages) return std::nullopt;
  const std::uint64_t views = shadowViewsOf(method);
  if (method.stages->storage == Storage::linear) {
    std::uint64_t texels = std::uint64_t{method.settings.width} * method.settings.height * views;
    if (method.stages->partition == Partition::tiles) {
      texels = 0;
      for (const std::uint64_t side : method.settings.tileSizes) texels += side * side;
    }
    const std::uint64_t most = device.limits().maxStorageBufferRange;
    if (4 * texels > most)
      return fmt::format("its maps take {} bytes of one buffer, this device's have at most {}: ask for smaller ones",
                         4 * texels, most);
    return std::nullopt;
  }
  const std::uint64_t columns = mapColumnsOf(method), rows = (views + columns - 1) / columns;
  const unsigned limit = device.limits().maxImageDimension2D;
  if (method.settings.width * columns > limit || method.settings.height * rows > limit)
    return fmt::format("its maps, {} beside each other, must fit into {} texels a side on this device", columns, limit);
  return std::nullopt;
}

FrameStore::FrameStore(const Device& device, const Method& method, const shared::FrameConstants& constants)
    : maps_(mapsOf(method, constants)),
      texels_(texelsOf(maps_)),
      isLinear_(method.stages->storage == Storage::linear),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)) {
  const VkExtent2D extent =
      isLinear_ ? VkExtent2D{1, 1} : VkExtent2D{constants.storeSize.x, constants.storeSize.y};
  image_ = GpuImage(device, extent, VK_FORMAT_D32_SFLOAT,
                    VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
  linear_ = Buffer(device, isLinear_ ? bytes() : 0,
                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  device.submit([&](VkCommandBuffer command) {
    transition(command, image_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

void FrameStore::record(VkCommandBuffer command, const std::function<void(std::uint32_t)>& draw) const {
  const auto drawAll = [&] {
    for (std::uint32_t view = 0; view < maps_.size(); ++view) {
      const VkRect2D& map = maps_[view];
      const VkViewport viewport{static_cast<float>(map.offset.x),
                                static_cast<float>(map.offset.y),
                                static_cast<float>(map.extent.width),
                                static_cast<float>(map.extent.height),
                                0,
                                1};
      vkCmdSetViewport(command, 0, 1, &viewport);
      vkCmdSetScissor(command, 0, 1, &map);
      draw(view);
    }
  };
  if (!isLinear_) return renderInto(command, {}, &image_, drawAll);

  vkCmdFillBuffer(command, linear_, 0, VK_WHOLE_SIZE, 0);
  barrier(command);
  VkExtent2D largest{1, 1};
  for (const VkRect2D& map : maps_)
    largest = {std::max(largest.width, map.extent.width), std::max(largest.height, map.extent.height)};
  renderNowhere(command, largest, drawAll);
  barrier(command);
}

void FrameStore::bindTo(BindingSet& bindings) const {
  bindings.set(shared::kBindStore, image_, nearest_);
  bindings.set(shared::kBindLinear, linear_);
}

}  // namespace sundial
