// Owns one Vulkan object that a device made, and destroys it.
#pragma once

#include <vulkan/vulkan.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace sundial {

// The machine failed (device lost, out of memory, a broken driver): nothing a request could have avoided.
class GpuError : public std::runtime_error {
 public:
  GpuError(VkResult result, const std::string& what)
      : std::runtime_error(what + " failed (VkResult " + std::to_string(static_cast<int>(result)) + ")"),
        result(result) {}
  VkResult result;
};

inline void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw GpuError(result, what);
}

template <class T, auto destroy>
class Handle {
 public:
  Handle() = default;
  Handle(VkDevice device, T handle) : device_(device), handle_(handle) {}
  Handle(Handle&& other) noexcept
      : device_(other.device_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Handle() {
    if (handle_ != VK_NULL_HANDLE) destroy(device_, handle_, nullptr);
  }
  operator T() const { return handle_; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  T handle_ = VK_NULL_HANDLE;
};

using Memory = Handle<VkDeviceMemory, vkFreeMemory>;
using ShaderModule = Handle<VkShaderModule, vkDestroyShaderModule>;
using DescriptorSetLayout = Handle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using DescriptorPool = Handle<VkDescriptorPool, vkDestroyDescriptorPool>;
using PipelineLayout = Handle<VkPipelineLayout, vkDestroyPipelineLayout>;
using Pipeline = Handle<VkPipeline, vkDestroyPipeline>;
using Sampler = Handle<VkSampler, vkDestroySampler>;
using QueryPool = Handle<VkQueryPool, vkDestroyQueryPool>;
using CommandPool = Handle<VkCommandPool, vkDestroyCommandPool>;
using Fence = Handle<VkFence, vkDestroyFence>;

}  // namespace sundial
