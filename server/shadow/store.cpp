#include "shadow/store.h"

#include <fmt/format.h>

#include <algorithm>

#include "shadow/depth_store.h"
#include "shadow/linear_store.h"
#include "shadow/moment_store.h"
#include "shadow/plan_settings.h"
#include "shadow/raster_choice.h"
#include "shadow/triangle_store.h"
#include "shadow/warp_maps.h"
#include "shared/bindings.h"

namespace sundial {

std::vector<VkRect2D> mapsOf(const Method& method) {
  std::vector<VkRect2D> maps;
  const std::uint32_t columns = mapColumnsOf(method);
  for (const glm::uvec2& size : mapSizesOf(method)) {
    const auto view = static_cast<std::uint32_t>(maps.size());
    const glm::ivec2 place(size * glm::uvec2(view % columns, view / columns));
    maps.push_back({{place.x, place.y}, {size.x, size.y}});
  }
  return maps;
}

std::uint64_t texelsOf(const shared::Plan& plan) {
  std::uint64_t texels = 0;
  for (std::uint32_t view = 0; view < plan.viewCount; ++view)
    texels += std::uint64_t{plan.views[view].rectSize.x} * plan.views[view].rectSize.y;
  return texels;
}

std::optional<std::string> whyTooLarge(const Method& method, const Device& device) {
  if (!method.stages) return std::nullopt;
  const std::uint64_t views = shadowViewsOf(method);
  const WarpSizes warp = warpSizesOf(method.stages->warp, {method.settings.width, method.settings.height});
  const std::uint64_t tables = views * sizeof(glm::vec2) * std::max(warp.functions, warp.centres);
  if (tables > device.limits().maxStorageBufferRange)
    return fmt::format(
        "the tables of its warp take {} bytes, a buffer of this device has at most {}: ask for fewer texels",
        tables, device.limits().maxStorageBufferRange);
  const bool ids = keepsIds(method.stages->storage);
  if (ids && !device.hasInt64Atomics())
    return "storage=depth-id and storage=triangle keep depths and triangles by 64-bit atomics, which this "
           "device "
           "can't: use storage=depth";
  if (ids || method.stages->storage == Storage::linear || method.settings.raster == Raster::compute) {
    const std::uint64_t bytes = texelsOf(mapSizesOf(method)) * linearBytesPerTexel(*method.stages);
    const std::uint64_t most = device.limits().maxStorageBufferRange;
    if (bytes > most)
      return fmt::format(
          "its maps take {} bytes of one buffer, this device's have at most {}: ask for smaller ones", bytes,
          most);
    return std::nullopt;
  }
  if (method.stages->storage == Storage::moments) {
    const std::uint64_t side = std::max(method.settings.width, method.settings.height);
    if (side > device.limits().maxImageDimension2D)
      return fmt::format("a map's side has at most {} texels on this device",
                         device.limits().maxImageDimension2D);
    if (!(device.limits().sampledImageDepthSampleCounts & VK_SAMPLE_COUNT_4_BIT))
      return "storage=moments reads four samples of depth a texel, which this device can't";
    return std::nullopt;
  }
  const std::uint64_t columns = mapColumnsOf(method), rows = (views + columns - 1) / columns;
  const unsigned limit = device.limits().maxImageDimension2D;
  if (method.settings.width * columns > limit || method.settings.height * rows > limit)
    return fmt::format("its maps, {} beside each other, must fit into {} texels a side on this device",
                       columns, limit);
  return std::nullopt;
}

std::unique_ptr<Store> makeStore(const Device& device, FramePipelines& pipelines, const Method& method,
                                 const shared::FrameConstants& constants) {
  if (method.stages->storage == Storage::triangle)
    return std::make_unique<TriangleStore>(device, pipelines, method, constants);
  if (isLinear(method)) return std::make_unique<LinearStore>(device, pipelines, method, constants);
  if (method.stages->storage == Storage::moments)
    return std::make_unique<MomentStore>(device, pipelines, method, constants);
  return std::make_unique<DepthStore>(device, pipelines, method, constants);
}

void drawMaps(VkCommandBuffer command, const std::vector<VkRect2D>& maps, const Store::DrawView& draw) {
  for (std::uint32_t view = 0; view < maps.size(); ++view) {
    const VkRect2D& map = maps[view];
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
}

void drawPlaced(VkCommandBuffer command, const glm::uvec2& viewport, VkExtent2D extent, std::uint32_t views,
                const Store::DrawView& draw) {
  const VkViewport all{0, 0, static_cast<float>(viewport.x), static_cast<float>(viewport.y), 0, 1};
  const VkRect2D inside{{0, 0}, extent};
  vkCmdSetViewport(command, 0, 1, &all);
  vkCmdSetScissor(command, 0, 1, &inside);
  for (std::uint32_t view = 0; view < views; ++view) draw(view);
}

void bindNoStore(BindingSet& bindings, const GpuImage& unread, VkSampler sampler,
                 const TexelBuffer& unreadToo) {
  for (const std::uint32_t binding :
       {shared::kBindStore, shared::kBindMultisampled, shared::kBindMoments, shared::kBindBlurred})
    bindings.set(binding, unread, sampler);
  for (const std::uint32_t binding :
       {shared::kBindLinear, shared::kBindRaster, shared::kBindListed, shared::kBindParts, shared::kBindBands,
        shared::kBindWarps, shared::kBindImportance, shared::kBindWanted})
    bindings.set(binding, static_cast<const Buffer&>(unreadToo));
  for (const std::uint32_t binding :
       {shared::kBindLinearTexels, shared::kBindWarpTexels, shared::kBindCentreTexels})
    bindings.set(binding, unreadToo);
}

TexelBuffer unreadBuffer(const Device& device) {
  return {device,
          Buffer(device, 0,
                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                     VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT),
          VK_FORMAT_R32_UINT, 4};
}

}  // namespace sundial
