#include "gpu/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstring>

#include "gpu/driver_memory.h"

namespace sundial {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                         VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* counter) {
  static_cast<std::atomic<std::uint64_t>*>(counter)->fetch_add(1);
  std::fprintf(stderr, "vulkan: %s\n", data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(void* counter) {
  return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
          .messageSeverity =
              VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
          .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
          .pfnUserCallback = onMessage,
          .pUserData = counter};
}

bool layerExists(const char* name) {
  std::uint32_t count = 0;
  check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
  std::vector<VkLayerProperties> layers(count);
  check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
  return std::ranges::any_of(layers, [&](const auto& layer) { return !std::strcmp(layer.layerName, name); });
}

// `counter` null: no validation.
Result<VkInstance> makeInstance(void* counter) {
  if (counter && !layerExists(kValidationLayer))
    return fail(
        ErrorCode::failedPrecondition,
        "the Vulkan validation layer is not installed: install vulkan-validationlayers or start without "
        "--validation");
  const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                      .pApplicationName = "sundial",
                                      .applicationVersion = 1,
                                      .apiVersion = VK_API_VERSION_1_3};
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  const VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(counter);
  const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                  .pNext = counter ? &messenger : nullptr,
                                  .pApplicationInfo = &application,
                                  .enabledLayerCount = counter ? 1u : 0u,
                                  .ppEnabledLayerNames = &kValidationLayer,
                                  .enabledExtensionCount = counter ? 1u : 0u,
                                  .ppEnabledExtensionNames = &extension};
  VkInstance instance = VK_NULL_HANDLE;
  if (const VkResult result = vkCreateInstance(&info, nullptr, &instance); result != VK_SUCCESS)
    return fail(
        ErrorCode::failedPrecondition,
        fmt::format("no Vulkan driver could be loaded (VkResult {}): install mesa-vulkan-drivers or a "
                    "driver for the GPU",
                    static_cast<int>(result)));
  return instance;
}

// The features that the frame rests on, in the order in which structures are chained.
struct Features {
  VkPhysicalDeviceVulkan13Features v13{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  VkPhysicalDeviceVulkan12Features v12{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                                       .pNext = &v13};
  VkPhysicalDeviceVulkan11Features v11{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES,
                                       .pNext = &v12};
  VkPhysicalDeviceFeatures2 all{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &v11};

  struct Item {
    const char* name;
    VkBool32* flag;
  };
  std::array<Item, 12> needed() {
    return {{{"dynamicRendering", &v13.dynamicRendering},
             {"synchronization2", &v13.synchronization2},
             {"maintenance4", &v13.maintenance4},
             {"scalarBlockLayout", &v12.scalarBlockLayout},
             {"drawIndirectCount", &v12.drawIndirectCount},
             {"depthClamp", &all.features.depthClamp},
             {"shaderClipDistance", &all.features.shaderClipDistance},
             {"multiDrawIndirect", &all.features.multiDrawIndirect},
             {"drawIndirectFirstInstance", &all.features.drawIndirectFirstInstance},
             {"pipelineStatisticsQuery", &all.features.pipelineStatisticsQuery},
             {"vertexPipelineStoresAndAtomics", &all.features.vertexPipelineStoresAndAtomics},
             {"fragmentStoresAndAtomics", &all.features.fragmentStoresAndAtomics}}};
  }
};

}  // namespace

struct Device::Candidate {
  VkPhysicalDevice physical;
  DeviceInfo info;
  VkPhysicalDeviceType type;
  std::string lacking;  // the first thing that it can't do, empty if none
};

Result<std::vector<Device::Candidate>> Device::candidates(VkInstance instance) {
  std::uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> physical(count);
  check(vkEnumeratePhysicalDevices(instance, &count, physical.data()), "vkEnumeratePhysicalDevices");
  std::vector<Candidate> found;
  for (VkPhysicalDevice device : physical) {
    VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &driver};
    vkGetPhysicalDeviceProperties2(device, &properties);
    Candidate candidate{
        device,
        {properties.properties.deviceName, fmt::format("{}, {}", driver.driverName, driver.driverInfo)},
        properties.properties.deviceType,
        {}};
    if (properties.properties.apiVersion < VK_API_VERSION_1_3) {
      candidate.lacking = "Vulkan 1.3";
    } else {
      Features features;
      vkGetPhysicalDeviceFeatures2(device, &features.all);
      for (const auto& item : features.needed())
        if (!*item.flag && candidate.lacking.empty()) candidate.lacking = item.name;
    }
    found.push_back(std::move(candidate));
  }
  return found;
}

Result<std::vector<DeviceInfo>> Device::list() {
  auto instance = makeInstance(nullptr);
  if (!instance) return std::unexpected(instance.error());
  auto found = candidates(*instance);
  std::vector<DeviceInfo> infos;
  if (found) std::ranges::transform(*found, std::back_inserter(infos), &Candidate::info);
  vkDestroyInstance(*instance, nullptr);
  return infos;
}

Result<std::unique_ptr<Device>> Device::create(std::string_view wanted, bool validation,
                                               ShaderStages stages) {
  std::unique_ptr<Device> self(new Device);
  auto instance = makeInstance(validation ? self->messages_.get() : nullptr);
  if (!instance) return std::unexpected(instance.error());
  self->instance_ = *instance;
  if (validation) {
    const auto info = messengerInfo(self->messages_.get());
    const auto make = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(self->instance_, "vkCreateDebugUtilsMessengerEXT"));
    check(make(self->instance_, &info, nullptr, &self->messenger_), "vkCreateDebugUtilsMessengerEXT");
  }

  const auto found = candidates(self->instance_);
  if (!found) return std::unexpected(found.error());
  std::string names;
  for (std::size_t i = 0; i < found->size(); ++i)
    names += fmt::format("{}{} \"{}\"", i ? ", " : "", i, (*found)[i].info.name);
  if (found->empty()) names = "none";

  // Nothing wanted: a GPU before a CPU driver, in the loader's order otherwise.
  const Candidate* chosen = nullptr;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  const bool isIndex = !wanted.empty() && error == std::errc() && end == wanted.data() + wanted.size();
  for (std::size_t i = 0; i < found->size(); ++i) {
    const Candidate& candidate = (*found)[i];
    if (wanted.empty()) {
      if (!candidate.lacking.empty()) continue;
      if (!chosen ||
          (chosen->type == VK_PHYSICAL_DEVICE_TYPE_CPU && candidate.type != VK_PHYSICAL_DEVICE_TYPE_CPU))
        chosen = &candidate;
    } else if (!chosen && (isIndex ? i == index : candidate.info.name.find(wanted) != std::string::npos)) {
      chosen = &candidate;
    }
  }
  if (!chosen)
    return fail(ErrorCode::notFound,
                wanted.empty()
                    ? fmt::format("no usable Vulkan 1.3 device (there are: {})", names)
                    : fmt::format("no Vulkan device matches \"{}\": choose an index or a part of a name "
                                  "from {}",
                                  wanted, names));
  if (!chosen->lacking.empty())
    return fail(ErrorCode::failedPrecondition, fmt::format("device \"{}\" lacks {}: choose another of {}",
                                                           chosen->info.name, chosen->lacking, names));
  self->info_ = chosen->info;
  self->isCpu_ = chosen->type == VK_PHYSICAL_DEVICE_TYPE_CPU;
  if (self->isCpu_) keepFreedMemory();
  self->open(chosen->physical, stages);
  return self;
}

void Device::open(VkPhysicalDevice physical, ShaderStages stages) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical, &properties);
  limits_ = properties.limits;
  vkGetPhysicalDeviceMemoryProperties(physical, &memory_);

  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  const auto family = std::ranges::find_if(families, [](const auto& f) {
    return (f.queueFlags & kWanted) == kWanted && f.timestampValidBits > 0;
  });
  if (family == families.end())
    throw GpuError(VK_ERROR_FEATURE_NOT_PRESENT, "finding a graphics queue with timestamps");
  const auto familyIndex = static_cast<std::uint32_t>(family - families.begin());

  Features offered, features;
  vkGetPhysicalDeviceFeatures2(physical, &offered.all);
  for (const auto& item : features.needed()) *item.flag = VK_TRUE;
  hasInt64Atomics_ = offered.all.features.shaderInt64 && offered.v12.shaderBufferInt64Atomics;
  if (stages == ShaderStages::all) {
    features.all.features.geometryShader = offered.all.features.geometryShader;
    features.all.features.tessellationShader = offered.all.features.tessellationShader;
  }
  hasGeometryShaders_ = features.all.features.geometryShader == VK_TRUE;
  hasTessellationShaders_ = features.all.features.tessellationShader == VK_TRUE;
  features.all.features.shaderInt64 = features.v12.shaderBufferInt64Atomics = hasInt64Atomics_;
  const float priority = 1;
  const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                      .queueFamilyIndex = familyIndex,
                                      .queueCount = 1,
                                      .pQueuePriorities = &priority};
  const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                .pNext = &features.all,
                                .queueCreateInfoCount = 1,
                                .pQueueCreateInfos = &queue};
  check(vkCreateDevice(physical, &info, nullptr, &device_), "vkCreateDevice");
  vkGetDeviceQueue(device_, familyIndex, 0, &queue_);

  const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                     .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                     .queueFamilyIndex = familyIndex};
  VkCommandPool commandPool;
  check(vkCreateCommandPool(device_, &pool, nullptr, &commandPool), "vkCreateCommandPool");
  commands_ = CommandPool(device_, commandPool);
  const VkCommandBufferAllocateInfo buffers{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                            .commandPool = commandPool,
                                            .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                            .commandBufferCount = 1};
  check(vkAllocateCommandBuffers(device_, &buffers, &command_), "vkAllocateCommandBuffers");
  const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  VkFence made;
  check(vkCreateFence(device_, &fence, nullptr, &made), "vkCreateFence");
  fence_ = Fence(device_, made);
}

Device::~Device() {
  if (device_) {
    vkDeviceWaitIdle(device_);
    fence_ = {};
    commands_ = {};
    vkDestroyDevice(device_, nullptr);
  }
  if (messenger_)
    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"))(instance_, messenger_, nullptr);
  if (instance_) vkDestroyInstance(instance_, nullptr);
}

Memory Device::allocate(const VkMemoryRequirements& requirements, MemoryUse use) const {
  constexpr VkMemoryPropertyFlags kMapped =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  const VkMemoryPropertyFlags needed = use == MemoryUse::device ? 0 : kMapped;
  const VkMemoryPropertyFlags liked = use == MemoryUse::device     ? VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT
                                      : use == MemoryUse::readback ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT
                                                                   : 0;
  int best = -1;
  for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
    const VkMemoryPropertyFlags flags = memory_.memoryTypes[i].propertyFlags;
    if (!(requirements.memoryTypeBits & 1u << i) || (flags & needed) != needed) continue;
    if (best < 0 || ((flags & liked) == liked && (memory_.memoryTypes[best].propertyFlags & liked) != liked))
      best = static_cast<int>(i);
  }
  if (best < 0) throw GpuError(VK_ERROR_FEATURE_NOT_PRESENT, "finding a memory type");
  const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                  .allocationSize = requirements.size,
                                  .memoryTypeIndex = static_cast<std::uint32_t>(best)};
  VkDeviceMemory memory;
  check(vkAllocateMemory(device_, &info, nullptr, &memory), "vkAllocateMemory");
  return {device_, memory};
}

void Device::submit(const std::function<void(VkCommandBuffer)>& record) const {
  const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                       .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  check(vkBeginCommandBuffer(command_, &begin), "vkBeginCommandBuffer");
  record(command_);
  check(vkEndCommandBuffer(command_), "vkEndCommandBuffer");
  const VkCommandBufferSubmitInfo command{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                          .commandBuffer = command_};
  const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                           .commandBufferInfoCount = 1,
                           .pCommandBufferInfos = &command,
                           .pSignalSemaphoreInfos = nullptr};
  const VkFence fence = fence_;
  check(vkQueueSubmit2(queue_, 1, &info, fence), "vkQueueSubmit2");
  check(vkWaitForFences(device_, 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
  check(vkResetFences(device_, 1, &fence), "vkResetFences");
}

}  // namespace sundial
