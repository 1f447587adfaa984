#include "shadow/linear_store.h"

#include <algorithm>

#include "gpu/rendering.h"
#include "shadow/plan_settings.h"
#include "shared/bindings.h"

namespace sundial {

LinearStore::LinearStore(const Device& device, const Method& method)
    : maps_(mapsOf(method)),
      texels_(texelsOf(mapSizesOf(method))),
      depths_(device, texels_ * sizeof(float),
              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT),
      unread_(device, {1, 1}, VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_SAMPLED_BIT),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)) {
  device.submit([&](VkCommandBuffer command) {
    transition(command, unread_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

void LinearStore::record(VkCommandBuffer command, const DrawView& draw) const {
  vkCmdFillBuffer(command, depths_, 0, VK_WHOLE_SIZE, 0);
  barrier(command);
  VkExtent2D largest{1, 1};
  for (const VkRect2D& map : maps_)
    largest = {std::max(largest.width, map.extent.width), std::max(largest.height, map.extent.height)};
  renderNowhere(command, largest, [&] { drawMaps(command, maps_, draw); });
  barrier(command);
}

void LinearStore::bindTo(BindingSet& bindings) const { bindNoStore(bindings, unread_, nearest_, depths_); }

}  // namespace sundial
