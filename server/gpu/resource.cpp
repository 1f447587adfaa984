#include "gpu/resource.h"

#include <algorithm>
#include <cstring>

namespace sundial {

Buffer::Buffer(const Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, MemoryUse use)
    : size_(std::max<VkDeviceSize>(bytes, 16)) {
  const VkBufferCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
      .size = size_,
      .usage = usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
      .pQueueFamilyIndices = nullptr};
  VkBuffer buffer;
  check(vkCreateBuffer(device, &info, nullptr, &buffer), "vkCreateBuffer");
  buffer_ = {device, buffer};
  VkMemoryRequirements requirements;
  vkGetBufferMemoryRequirements(device, buffer, &requirements);
  memory_ = device.allocate(requirements, use);
  check(vkBindBufferMemory(device, buffer, memory_, 0), "vkBindBufferMemory");
  if (use != MemoryUse::device) check(vkMapMemory(device, memory_, 0, size_, 0, &mapped_), "vkMapMemory");
}

Buffer uploaded(const Device& device, const void* data, VkDeviceSize bytes, VkBufferUsageFlags usage) {
  Buffer target(device, bytes, usage);
  if (bytes == 0) return target;
  const Buffer staging(device, bytes, 0, MemoryUse::upload);
  std::memcpy(staging.mapped<std::byte>(), data, bytes);
  device.submit([&](VkCommandBuffer command) {
    const VkBufferCopy region{.size = bytes};
    vkCmdCopyBuffer(command, staging, target, 1, &region);
    barrier(command);
  });
  return target;
}

TexelBuffer::TexelBuffer(const Device& device, Buffer buffer, VkFormat format, std::uint32_t bytesPerTexel)
    : buffer_(std::move(buffer)) {
  if (buffer_.size() / bytesPerTexel > device.limits().maxTexelBufferElements)
    throw GpuError(VK_ERROR_OUT_OF_DEVICE_MEMORY, "viewing a buffer of more texels than the device reads");
  const VkBufferViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                    .buffer = buffer_,
                                    .format = format,
                                    .range = VK_WHOLE_SIZE};
  VkBufferView view;
  check(vkCreateBufferView(device, &info, nullptr, &view), "vkCreateBufferView");
  view_ = {device, view};
}

GpuImage::GpuImage(const Device& device, VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
                   std::uint32_t layers, bool arrayView)
    : extent_(extent),
      format_(format),
      aspect_(format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT) {
  const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                               .imageType = VK_IMAGE_TYPE_2D,
                               .format = format,
                               .extent = {extent.width, extent.height, 1},
                               .mipLevels = 1,
                               .arrayLayers = layers,
                               .samples = VK_SAMPLE_COUNT_1_BIT,
                               .tiling = VK_IMAGE_TILING_OPTIMAL,
                               .usage = usage,
                               .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
  VkImage image;
  check(vkCreateImage(device, &info, nullptr, &image), "vkCreateImage");
  image_ = {device, image};
  VkMemoryRequirements requirements;
  vkGetImageMemoryRequirements(device, image, &requirements);
  bytes_ = requirements.size;
  memory_ = device.allocate(requirements, MemoryUse::device);
  check(vkBindImageMemory(device, image, memory_, 0), "vkBindImageMemory");
  const VkImageViewCreateInfo viewInfo{
      .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
      .image = image,
      .viewType = arrayView ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D,
      .format = format,
      .subresourceRange = {aspect_, 0, 1, 0, layers}};
  VkImageView view;
  check(vkCreateImageView(device, &viewInfo, nullptr, &view), "vkCreateImageView");
  view_ = {device, view};
}

void barrier(VkCommandBuffer command) {
  const VkMemoryBarrier2 memory{
      .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
      .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
      .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
      .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
      .dstAccessMask =
          VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT | VK_ACCESS_2_HOST_READ_BIT};
  const VkDependencyInfo info{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &memory};
  vkCmdPipelineBarrier2(command, &info);
}

void transition(VkCommandBuffer command, const GpuImage& image, VkImageLayout from, VkImageLayout to) {
  const VkImageMemoryBarrier2 change{
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
      .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
      .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
      .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
      .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
      .oldLayout = from,
      .newLayout = to,
      .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
      .image = image,
      .subresourceRange = {image.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}};
  const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                              .imageMemoryBarrierCount = 1,
                              .pImageMemoryBarriers = &change};
  vkCmdPipelineBarrier2(command, &info);
}

std::vector<std::byte> downloaded(const Device& device, const Buffer& source) {
  const Buffer staging(device, source.size(), 0, MemoryUse::readback);
  device.submit([&](VkCommandBuffer command) {
    barrier(command);
    const VkBufferCopy region{.size = source.size()};
    vkCmdCopyBuffer(command, source, staging, 1, &region);
    barrier(command);
  });
  const auto* begin = staging.mapped<const std::byte>();
  return {begin, begin + source.size()};
}

namespace {
VkBufferImageCopy wholeImage(const GpuImage& image) {
  return {.imageSubresource = {image.aspect(), 0, 0, 1},
          .imageExtent = {image.extent().width, image.extent().height, 1}};
}
}  // namespace

void copyToBuffer(VkCommandBuffer command, const GpuImage& source, const Buffer& target) {
  const VkBufferImageCopy region = wholeImage(source);
  transition(command, source, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  vkCmdCopyImageToBuffer(command, source, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target, 1, &region);
  transition(command, source, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  barrier(command);
}

void copyToImage(VkCommandBuffer command, const Buffer& source, const GpuImage& target) {
  const VkBufferImageCopy region = wholeImage(target);
  transition(command, target, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  vkCmdCopyBufferToImage(command, source, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  transition(command, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

std::vector<std::byte> downloaded(const Device& device, const GpuImage& source, VkDeviceSize bytesPerTexel) {
  const VkDeviceSize bytes = bytesPerTexel * source.extent().width * source.extent().height;
  const Buffer staging(device, bytes, 0, MemoryUse::readback);
  device.submit([&](VkCommandBuffer command) { copyToBuffer(command, source, staging); });
  const auto* begin = staging.mapped<const std::byte>();
  return {begin, begin + bytes};
}

}  // namespace sundial
