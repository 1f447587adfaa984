#include "shadow/depth_store.h"

#include "gpu/rendering.h"
#include "shadow/plan_settings.h"
#include "shared/bindings.h"

namespace sundial {

DepthStore::DepthStore(const Device& device, const Method& method, const shared::FrameConstants& constants)
    : device_(device),
      maps_(mapsOf(method)),
      texels_(texelsOf(mapSizesOf(method))),
      image_(device, {constants.storeSize.x, constants.storeSize.y}, VK_FORMAT_D32_SFLOAT,
             VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT),
      unread_(device, 0, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)) {
  device.submit([&](VkCommandBuffer command) {
    transition(command, image_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

void DepthStore::record(VkCommandBuffer command, const DrawView& draw) const {
  renderInto(command, {}, &image_, [&] { drawMaps(command, maps_, draw); });
}

std::vector<float> DepthStore::depths() const {
  return valuesOf<float>(downloaded(device_, image_, sizeof(float)));
}

void DepthStore::bindTo(BindingSet& bindings) const {
  bindNoStore(bindings, image_, nearest_, unread_);
  bindings.set(shared::kBindStore, image_, nearest_);
}

}  // namespace sundial
