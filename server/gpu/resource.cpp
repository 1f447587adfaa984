#include "gpu/resource.h"

#include <algorithm>
#include <bit>
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

std::uint32_t levelsOf(VkExtent2D extent) {
  return static_cast<std::uint32_t>(std::bit_width(std::max(extent.width, extent.height)));
}

namespace {
Handle<VkImageView, vkDestroyImageView> makeView(const Device& device, VkImage image, VkFormat format,
                                                 VkImageViewType type, const VkImageSubresourceRange& range) {
  const VkImageViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                   .image = image,
                                   .viewType = type,
                                   .format = format,
                                   .subresourceRange = range};
  VkImageView view;
  check(vkCreateImageView(device, &info, nullptr, &view), "vkCreateImageView");
  return {device, view};
}
}  // namespace

GpuImage::GpuImage(const Device& device, VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
                   const ImageParts& parts)
    : extent_(extent),
      parts_(parts),
      format_(format),
      aspect_(format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT) {
  const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                               .imageType = VK_IMAGE_TYPE_2D,
                               .format = format,
                               .extent = {extent.width, extent.height, 1},
                               .mipLevels = parts.levels,
                               .arrayLayers = parts.layers,
                               .samples = parts.samples,
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
  view_ = makeView(device, image, format, parts.array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D,
                   {aspect_, 0, parts.levels, 0, parts.layers});
  if (!parts.array || !(usage & VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT)) return;
  for (std::uint32_t layer = 0; layer < parts.layers; ++layer)
    layers_.push_back(makeView(device, image, format, VK_IMAGE_VIEW_TYPE_2D, {aspect_, 0, 1, layer, 1}));
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

namespace {
void transitionLevels(VkCommandBuffer command, const GpuImage& image, std::uint32_t first,
                      std::uint32_t levels, VkImageLayout from, VkImageLayout to) {
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
      .subresourceRange = {image.aspect(), first, levels, 0, VK_REMAINING_ARRAY_LAYERS}};
  const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                              .imageMemoryBarrierCount = 1,
                              .pImageMemoryBarriers = &change};
  vkCmdPipelineBarrier2(command, &info);
}

}  // namespace

void transition(VkCommandBuffer command, const GpuImage& image, VkImageLayout from, VkImageLayout to) {
  transitionLevels(command, image, 0, VK_REMAINING_MIP_LEVELS, from, to);
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

void fillLevels(VkCommandBuffer command, const GpuImage& image) {
  const auto [layers, array, levels, samples] = image.parts();
  const auto cornerOf = [&](std::uint32_t level) {
    return VkOffset3D{static_cast<std::int32_t>(std::max(image.extent().width >> level, 1u)),
                      static_cast<std::int32_t>(std::max(image.extent().height >> level, 1u)), 1};
  };
  constexpr VkImageLayout kRead = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  constexpr VkImageLayout kFrom = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                          kTo = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  transition(command, image, kRead, kTo);
  transitionLevels(command, image, 0, 1, kTo, kFrom);
  for (std::uint32_t level = 1; level < levels; ++level) {
    const VkImageBlit half{.srcSubresource = {image.aspect(), level - 1, 0, layers},
                           .srcOffsets = {{}, cornerOf(level - 1)},
                           .dstSubresource = {image.aspect(), level, 0, layers},
                           .dstOffsets = {{}, cornerOf(level)}};
    vkCmdBlitImage(command, image, kFrom, image, kTo, 1, &half, VK_FILTER_LINEAR);
    transitionLevels(command, image, level, 1, kTo, kFrom);
  }
  transition(command, image, kFrom, kRead);
}

std::vector<std::byte> downloaded(const Device& device, const GpuImage& source, VkDeviceSize bytesPerTexel) {
  const VkDeviceSize bytes = bytesPerTexel * source.extent().width * source.extent().height;
  const Buffer staging(device, bytes, 0, MemoryUse::readback);
  device.submit([&](VkCommandBuffer command) { copyToBuffer(command, source, staging); });
  const auto* begin = staging.mapped<const std::byte>();
  return {begin, begin + bytes};
}

}  // namespace sundial
