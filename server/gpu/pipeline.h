// Shaders, the one set of bindings that all of them share, and pipelines.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <span>
#include <string_view>

#include "gpu/resource.h"

namespace sundial {

// SPIR-V of a file in shaders/, by its name. Throws std::out_of_range for a name that isn't there.
std::span<const std::uint32_t> shaderCode(std::string_view file);

// The layout of shared/bindings.h: one set, the same for every pipeline, and 128 bytes of push constants.
class BindingLayout {
 public:
  explicit BindingLayout(const Device&);
  VkDescriptorSetLayout set() const { return set_; }
  VkPipelineLayout pipeline() const { return pipeline_; }

 private:
  DescriptorSetLayout set_;
  PipelineLayout pipeline_;
};

// One descriptor set. Every binding must be set before it is bound: lavapipe follows those too that no shader
// reads.
class BindingSet {
 public:
  BindingSet(const Device&, const BindingLayout&);
  void set(std::uint32_t binding, const Buffer&);
  void set(std::uint32_t binding, const TexelBuffer&);
  void set(std::uint32_t binding, const GpuImage&, VkSampler,
           VkImageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  void bind(VkCommandBuffer) const;  // for graphics and compute

 private:
  VkDevice device_;
  VkPipelineLayout layout_;
  DescriptorPool pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

// Numbers for `layout(constant_id = i)`.
using Specialization = std::vector<std::uint32_t>;

Pipeline makeComputePipeline(const Device&, const BindingLayout&, std::string_view shader,
                             const Specialization& = {});

struct GraphicsPipelineInfo {
  std::string_view vertexShader;
  std::string_view fragmentShader;  // empty: depth only
  Specialization specialization = {};
  std::vector<VkVertexInputBindingDescription> vertexBindings = {};
  std::vector<VkVertexInputAttributeDescription> vertexAttributes = {};
  std::vector<VkFormat> colourFormats = {};
  bool depth = false;        // D32, reversed: nearer is greater
  bool depthAlways = false;  // drawn over what is there, whatever its depth
  bool depthClamp = false;   // casters before the near plane are kept, at depth 1
  // Where the device has them: Device::hasGeometryShaders(), hasTessellationShaders(). Tessellation: control
  // and evaluation, both or none.
  std::string_view geometryShader = {};
  std::array<std::string_view, 2> tessellationShaders = {};
  bool adds = false;  // fragments add up, instead of the last one staying
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};
// Triangles; viewport, scissor and (VK 1.3) cull mode are dynamic; counter-clockwise seen with y up is the
// front.
Pipeline makeGraphicsPipeline(const Device&, const BindingLayout&, const GraphicsPipelineInfo&);

Sampler makeSampler(const Device&, VkFilter);
// Linear within a level, of all levels; beyond the edges is what lies on them.
Sampler makeLevelSampler(const Device&);

}  // namespace sundial
