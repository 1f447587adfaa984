// Buffers and images that own their memory.
#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "gpu/device.h"

namespace sundial {

class Buffer {
 public:
  Buffer() = default;
  // `bytes` may be 0: a buffer of 16 bytes is made, so that it can be bound.
  Buffer(const Device&, VkDeviceSize bytes, VkBufferUsageFlags, MemoryUse = MemoryUse::device);

  operator VkBuffer() const { return buffer_; }
  VkDeviceSize size() const { return size_; }
  // Mapped memory; only of upload and readback buffers.
  template <class T>
  T* mapped() const {
    return static_cast<T*>(mapped_);
  }

 private:
  Memory memory_;  // freed after the buffer
  Handle<VkBuffer, vkDestroyBuffer> buffer_;
  VkDeviceSize size_ = 0;
  void* mapped_ = nullptr;
};

// A buffer in device memory with these contents.
Buffer uploaded(const Device&, const void* data, VkDeviceSize bytes, VkBufferUsageFlags);
template <class T>
Buffer uploaded(const Device& device, const std::vector<T>& data, VkBufferUsageFlags usage) {
  return uploaded(device, data.data(), data.size() * sizeof(T), usage);
}

// A buffer that shaders read as texels of a format.
class TexelBuffer {
 public:
  TexelBuffer() = default;
  // Throws GpuError (VK_ERROR_OUT_OF_DEVICE_MEMORY) where the device reads fewer texels through a view.
  TexelBuffer(const Device&, Buffer, VkFormat, std::uint32_t bytesPerTexel);

  operator const Buffer&() const { return buffer_; }
  VkBufferView view() const { return view_; }

 private:
  Buffer buffer_;
  Handle<VkBufferView, vkDestroyBufferView> view_;
};

// What an image has more of than one.
struct ImageParts {
  std::uint32_t layers = 1;
  bool array = false;  // is seen as an array, of one layer too
  std::uint32_t levels = 1;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

// As many levels as halving a side leaves texels.
std::uint32_t levelsOf(VkExtent2D);

class GpuImage {
 public:
  GpuImage() = default;
  GpuImage(const Device&, VkExtent2D, VkFormat, VkImageUsageFlags, const ImageParts& = {});

  operator VkImage() const { return image_; }
  VkImageView view() const { return view_; }  // of all layers and levels
  // The first level of a layer, to be drawn into.
  VkImageView layer(std::uint32_t index) const {
    return layers_.empty() ? VkImageView(view_) : layers_[index];
  }
  VkExtent2D extent() const { return extent_; }
  VkFormat format() const { return format_; }
  const ImageParts& parts() const { return parts_; }
  VkImageAspectFlags aspect() const { return aspect_; }
  VkDeviceSize bytes() const { return bytes_; }  // of memory

 private:
  Memory memory_;
  Handle<VkImage, vkDestroyImage> image_;
  Handle<VkImageView, vkDestroyImageView> view_;
  std::vector<Handle<VkImageView, vkDestroyImageView>> layers_;  // of arrays that are drawn into
  VkExtent2D extent_{};
  ImageParts parts_;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  VkImageAspectFlags aspect_ = 0;
  VkDeviceSize bytes_ = 0;
};

// Everything before is finished and visible to everything after. One barrier for all: passes are few and
// long.
void barrier(VkCommandBuffer);

// Moves an image to a layout, all earlier work done.
void transition(VkCommandBuffer, const GpuImage&, VkImageLayout from, VkImageLayout to);

// The whole of an image, texels tightly packed. The image must be in SHADER_READ_ONLY_OPTIMAL layout, and
// stays in it.
void copyToBuffer(VkCommandBuffer, const GpuImage&, const Buffer&);
void copyToImage(VkCommandBuffer, const Buffer&, const GpuImage&);

// Fills each level of all layers from the one before. In SHADER_READ_ONLY_OPTIMAL layout, and stays in it.
void fillLevels(VkCommandBuffer, const GpuImage&);

// Contents, on the host. An image must be in SHADER_READ_ONLY_OPTIMAL layout, and stays in it.
std::vector<std::byte> downloaded(const Device&, const Buffer&);
std::vector<std::byte> downloaded(const Device&, const GpuImage&, VkDeviceSize bytesPerTexel);

// Such contents as values.
template <class T>
std::vector<T> valuesOf(const std::vector<std::byte>& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

}  // namespace sundial
