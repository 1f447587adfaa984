// A Vulkan 1.3 device with one queue, its validation layer, and memory.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/device_info.h"
#include "gpu/handle.h"
#include "result.h"

namespace sundial {

enum class MemoryUse {
  device,    // the GPU reads and writes; not mapped
  upload,    // the host writes, the GPU reads; mapped
  readback,  // the GPU writes, the host reads, cached; mapped
};

// Which shader stages a device is opened with, where it has them.
enum class ShaderStages {
  frames,  // vertex, fragment and compute: what frames need
  all,     // geometry and tessellation too: papers' ways that benchmarks compare
};

class Device {
 public:
  // As Renderer::create.
  static Result<std::unique_ptr<Device>> create(std::string_view wanted, bool validation,
                                                ShaderStages = ShaderStages::frames);
  static Result<std::vector<DeviceInfo>> list();
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  operator VkDevice() const { return device_; }
  const DeviceInfo& info() const { return info_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  // The driver runs on the host's processor: passes are long, and its memory is the host's.
  bool isCpu() const { return isCpu_; }
  // 64-bit atomics on storage buffers, and 64-bit integers to do them with.
  bool hasInt64Atomics() const { return hasInt64Atomics_; }
  bool hasGeometryShaders() const { return hasGeometryShaders_; }
  bool hasTessellationShaders() const { return hasTessellationShaders_; }
  std::uint64_t validationMessages() const { return messages_->load(); }

  // Memory for these requirements. Throws GpuError, VK_ERROR_OUT_OF_DEVICE_MEMORY among others.
  Memory allocate(const VkMemoryRequirements&, MemoryUse) const;

  // Records, submits and waits. Throws GpuError.
  void submit(const std::function<void(VkCommandBuffer)>& record) const;

 private:
  Device() = default;
  struct Candidate;
  static Result<std::vector<Candidate>> candidates(VkInstance);
  void open(VkPhysicalDevice, ShaderStages);

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkPhysicalDeviceLimits limits_{};
  DeviceInfo info_;
  bool isCpu_ = false;
  bool hasInt64Atomics_ = false;
  bool hasGeometryShaders_ = false;
  bool hasTessellationShaders_ = false;
  std::unique_ptr<std::atomic<std::uint64_t>> messages_ = std::make_unique<std::atomic<std::uint64_t>>(0);
  CommandPool commands_;
  Fence fence_;
  VkCommandBuffer command_ = VK_NULL_HANDLE;
};

}  // namespace sundial
