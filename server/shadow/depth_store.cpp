#include "shadow/depth_store.h"

#include <algorithm>

#include "gpu/rendering.h"
#include "shadow/plan_settings.h"
#include "shared/bindings.h"

namespace sundial {

DepthStore::DepthStore(const Device& device, FramePipelines& pipelines, const Method& method,
                       const shared::FrameConstants& constants)
    : device_(device),
      layout_(pipelines.layout.pipeline()),
      clear_(pipelines.of(method).storeClear),
      maps_(mapsOf(method)),
      texels_(texelsOf(mapSizesOf(method))),
      viewport_(constants.settings.viewport),
      unread_(unreadBuffer(device)),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)) {
  make({constants.storeSize.x, constants.storeSize.y});
}

void DepthStore::make(VkExtent2D extent) {
  image_ = GpuImage(device_, extent, VK_FORMAT_D32_SFLOAT,
                    VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                        VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  device_.submit([&](VkCommandBuffer command) {
    transition(command, image_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

void DepthStore::record(VkCommandBuffer command, const DrawView& draw) const {
  if (clear_ == VK_NULL_HANDLE) {
    renderInto(command, {}, &image_, [&] { drawMaps(command, maps_, draw); });
    return;
  }
  // Clearing costs what is cleared, so only what the plan uses is.
  const auto views = static_cast<std::uint32_t>(maps_.size());
  renderOnto(command, {}, &image_, [&] {
    drawPlaced(command, viewport_, image_.extent(), views, [&](std::uint32_t view) {
      vkCmdPushConstants(command, layout_, VK_SHADER_STAGE_ALL, 0, sizeof view, &view);
      vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS, clear_);
      vkCmdDraw(command, 6, 1, 0, 0);
    });
    drawPlaced(command, viewport_, image_.extent(), views, draw);
  });
}

void DepthStore::fit(const shared::Plan& plan) {
  if (clear_ == VK_NULL_HANDLE) return;
  glm::uvec2 used(1);
  for (std::uint32_t view = 0; view < plan.viewCount; ++view)
    used = glm::max(used, plan.views[view].rectOffset + plan.views[view].rectSize);
  if (used == glm::uvec2(image_.extent().width, image_.extent().height)) return;
  make({used.x, used.y});
}

std::vector<float> DepthStore::depths() const {
  return valuesOf<float>(downloaded(device_, image_, sizeof(float)));
}

void DepthStore::bindTo(BindingSet& bindings) const {
  bindNoStore(bindings, image_, nearest_, unread_);
  bindings.set(shared::kBindStore, image_, nearest_);
}

std::uint64_t DepthStore::texels() const {
  if (clear_ == VK_NULL_HANDLE) return texels_;
  return std::uint64_t{image_.extent().width} * image_.extent().height;
}

}  // namespace sundial
