#include "gpu/rendering.h"

namespace sundial {

namespace {

constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
constexpr VkImageLayout kColour = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
constexpr VkImageLayout kDepth = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;

VkRenderingAttachmentInfo attachment(VkImageView view, VkImageLayout layout, VkAttachmentLoadOp load) {
  return {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
          .imageView = view,
          .imageLayout = layout,
          .loadOp = load,
          .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
}

void render(VkCommandBuffer command, const VkRenderingInfo& info, const std::function<void()>& draw) {
  const VkRect2D area = info.renderArea;
  vkCmdBeginRendering(command, &info);
  const VkViewport viewport{
      0, 0, static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1};
  vkCmdSetViewport(command, 0, 1, &viewport);
  vkCmdSetScissor(command, 0, 1, &area);
  vkCmdSetCullMode(command, VK_CULL_MODE_NONE);
  draw();
  vkCmdEndRendering(command);
}

void render(VkCommandBuffer command, const std::vector<const GpuImage*>& colours, const GpuImage* depth,
            VkAttachmentLoadOp load, const std::function<void()>& draw) {
  std::vector<VkRenderingAttachmentInfo> attachments;
  for (const GpuImage* image : colours) {
    transition(command, *image, kRead, kColour);
    attachments.push_back(attachment(image->view(), kColour, load));
  }
  VkRenderingAttachmentInfo depthAttachment{};
  if (depth) {
    transition(command, *depth, kRead, kDepth);
    depthAttachment = attachment(depth->view(), kDepth, load);
  }
  const VkExtent2D extent = depth ? depth->extent() : colours.front()->extent();
  render(command,
         {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
          .renderArea = {{0, 0}, extent},
          .layerCount = 1,
          .colorAttachmentCount = static_cast<std::uint32_t>(attachments.size()),
          .pColorAttachments = attachments.data(),
          .pDepthAttachment = depth ? &depthAttachment : nullptr},
         draw);
  for (const GpuImage* image : colours) transition(command, *image, kColour, kRead);
  if (depth) transition(command, *depth, kDepth, kRead);
}

}  // namespace

void renderInto(VkCommandBuffer command, const std::vector<const GpuImage*>& colours, const GpuImage* depth,
                const std::function<void()>& draw) {
  render(command, colours, depth, VK_ATTACHMENT_LOAD_OP_CLEAR, draw);
}

void renderOnto(VkCommandBuffer command, const std::vector<const GpuImage*>& colours, const GpuImage* depth,
                const std::function<void()>& draw) {
  render(command, colours, depth, VK_ATTACHMENT_LOAD_OP_LOAD, draw);
}

void renderIntoLayer(VkCommandBuffer command, const GpuImage& array, std::uint32_t layer,
                     const std::function<void()>& draw) {
  transition(command, array, kRead, kColour);
  const VkRenderingAttachmentInfo colour =
      attachment(array.layer(layer), kColour, VK_ATTACHMENT_LOAD_OP_CLEAR);
  render(command,
         {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
          .renderArea = {{0, 0}, array.extent()},
          .layerCount = 1,
          .colorAttachmentCount = 1,
          .pColorAttachments = &colour},
         draw);
  transition(command, array, kColour, kRead);
}

void renderNowhere(VkCommandBuffer command, VkExtent2D extent, const std::function<void()>& draw) {
  render(command,
         {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO, .renderArea = {{0, 0}, extent}, .layerCount = 1}, draw);
}

}  // namespace sundial
