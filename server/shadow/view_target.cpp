#include "shadow/view_target.h"

#include "shared/bindings.h"

namespace sundial {

namespace {
constexpr VkImageUsageFlags kRead = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
constexpr VkImageUsageFlags kColour =
    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | kRead;
}  // namespace

ViewTarget::ViewTarget(const Device& device, glm::uvec2 size)
    : depth(device, {size.x, size.y}, VK_FORMAT_D32_SFLOAT,
            VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | kRead),
      ids(device, {size.x, size.y}, VK_FORMAT_R32G32_UINT, kColour),
      visibility(device, {size.x, size.y}, VK_FORMAT_R32_SFLOAT, kColour),
      undecided(device, {size.x, size.y}, VK_FORMAT_D32_SFLOAT,
                VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | kRead),
      colour(device, {size.x, size.y}, VK_FORMAT_R8G8B8A8_UNORM, kColour),
      positions(device, {size.x, size.y}, VK_FORMAT_R32G32B32A32_UINT, kColour),
      normals(device, {size.x, size.y}, VK_FORMAT_R32G32B32A32_UINT, kColour),
      answers(device, {size.x, size.y}, VK_FORMAT_R32G32B32A32_UINT, kColour),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)) {
  device.submit([&](VkCommandBuffer command) {
    for (const GpuImage* image :
         {&depth, &ids, &visibility, &undecided, &colour, &positions, &normals, &answers})
      transition(command, *image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

void ViewTarget::bindTo(BindingSet& set) const {
  set.set(shared::kBindDepth, depth, nearest_);
  set.set(shared::kBindIds, ids, nearest_);
  set.set(shared::kBindVisibility, visibility, nearest_);
  set.set(shared::kBindPositions, positions, nearest_);
  set.set(shared::kBindNormals, normals, nearest_);
}

VkDeviceSize ViewTarget::bytes() const {
  return depth.bytes() + ids.bytes() + visibility.bytes() + undecided.bytes() + colour.bytes() +
         positions.bytes() + normals.bytes();
}

}  // namespace sundial
