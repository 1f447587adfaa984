#include "gpu/pipeline.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "shared/bindings.h"

namespace sundial {

namespace {

struct EmbeddedShader {
  std::string_view name;
  std::span<const std::uint32_t> code;
};

#include "shader_table.inc"

VkDescriptorType typeOf(std::uint32_t binding) {
  if (binding == shared::kBindFrame) return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  if (binding < shared::kStorageBindings) return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  if (binding < shared::kTexelBindings) return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
  return binding < shared::kStorageTexelBindings ? VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER
                                                 : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}

ShaderModule makeModule(const Device& device, std::string_view file) {
  const auto code = shaderCode(file);
  const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                      .codeSize = code.size_bytes(),
                                      .pCode = code.data()};
  VkShaderModule module;
  check(vkCreateShaderModule(device, &info, nullptr, &module), "vkCreateShaderModule");
  return {device, module};
}

// Points into `constants`, which must outlive it.
struct SpecializationInfo {
  explicit SpecializationInfo(const Specialization& constants) {
    for (std::uint32_t i = 0; i < constants.size(); ++i) entries.push_back({i, i * 4, 4});
    info = {static_cast<std::uint32_t>(entries.size()), entries.data(), constants.size() * 4,
            constants.data()};
  }
  std::vector<VkSpecializationMapEntry> entries;
  VkSpecializationInfo info;
};

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, VkShaderModule module,
                                      const SpecializationInfo& specialization) {
  return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
          .stage = bit,
          .module = module,
          .pName = "main",
          .pSpecializationInfo = &specialization.info};
}

}  // namespace

std::span<const std::uint32_t> shaderCode(std::string_view file) {
  const auto* found = std::ranges::find(kShaders, file, &EmbeddedShader::name);
  if (found == std::end(kShaders)) throw std::out_of_range("no shader is named " + std::string(file));
  return found->code;
}

BindingLayout::BindingLayout(const Device& device) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (std::uint32_t i = 0; i < shared::kBindCount; ++i)
    bindings.push_back({i, typeOf(i), 1, VK_SHADER_STAGE_ALL, nullptr});
  const VkDescriptorSetLayoutCreateInfo setInfo{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                .bindingCount = static_cast<std::uint32_t>(bindings.size()),
                                                .pBindings = bindings.data()};
  VkDescriptorSetLayout set;
  check(vkCreateDescriptorSetLayout(device, &setInfo, nullptr, &set), "vkCreateDescriptorSetLayout");
  set_ = {device, set};
  const VkPushConstantRange range{VK_SHADER_STAGE_ALL, 0, 128};
  const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                        .setLayoutCount = 1,
                                        .pSetLayouts = &set,
                                        .pushConstantRangeCount = 1,
                                        .pPushConstantRanges = &range};
  VkPipelineLayout layout;
  check(vkCreatePipelineLayout(device, &info, nullptr, &layout), "vkCreatePipelineLayout");
  pipeline_ = {device, layout};
}

BindingSet::BindingSet(const Device& device, const BindingLayout& layout)
    : device_(device), layout_(layout.pipeline()) {
  const VkDescriptorPoolSize sizes[] = {
      {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
      {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, shared::kStorageBindings - 1},
      {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, shared::kTexelBindings - shared::kStorageBindings},
      {VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, shared::kStorageTexelBindings - shared::kTexelBindings},
      {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, shared::kBindCount - shared::kStorageTexelBindings}};
  const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                        .maxSets = 1,
                                        .poolSizeCount = std::size(sizes),
                                        .pPoolSizes = sizes};
  VkDescriptorPool pool;
  check(vkCreateDescriptorPool(device, &info, nullptr, &pool), "vkCreateDescriptorPool");
  pool_ = {device, pool};
  const VkDescriptorSetLayout setLayout = layout.set();
  const VkDescriptorSetAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                             .descriptorPool = pool,
                                             .descriptorSetCount = 1,
                                             .pSetLayouts = &setLayout};
  check(vkAllocateDescriptorSets(device, &allocate, &set_), "vkAllocateDescriptorSets");
}

void BindingSet::set(std::uint32_t binding, const Buffer& buffer) {
  const VkDescriptorBufferInfo info{buffer, 0, VK_WHOLE_SIZE};
  const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                   .dstSet = set_,
                                   .dstBinding = binding,
                                   .descriptorCount = 1,
                                   .descriptorType = typeOf(binding),
                                   .pBufferInfo = &info};
  vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
}

void BindingSet::set(std::uint32_t binding, const TexelBuffer& buffer) {
  const VkBufferView view = buffer.view();
  const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                   .dstSet = set_,
                                   .dstBinding = binding,
                                   .descriptorCount = 1,
                                   .descriptorType = typeOf(binding),
                                   .pTexelBufferView = &view};
  vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
}

void BindingSet::set(std::uint32_t binding, const GpuImage& image, VkSampler sampler,
                     VkImageLayout imageLayout) {
  const VkDescriptorImageInfo info{sampler, image.view(), imageLayout};
  const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                   .dstSet = set_,
                                   .dstBinding = binding,
                                   .descriptorCount = 1,
                                   .descriptorType = typeOf(binding),
                                   .pImageInfo = &info,
                                   .pBufferInfo = nullptr};
  vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
}

void BindingSet::bind(VkCommandBuffer command) const {
  for (const auto point : {VK_PIPELINE_BIND_POINT_GRAPHICS, VK_PIPELINE_BIND_POINT_COMPUTE})
    vkCmdBindDescriptorSets(command, point, layout_, 0, 1, &set_, 0, nullptr);
}

Pipeline makeComputePipeline(const Device& device, const BindingLayout& layout, std::string_view shader,
                             const Specialization& constants) {
  const ShaderModule module = makeModule(device, shader);
  const SpecializationInfo specialization(constants);
  const VkComputePipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                         .stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, module, specialization),
                                         .layout = layout.pipeline()};
  VkPipeline pipeline;
  check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "vkCreateComputePipelines");
  return {device, pipeline};
}

Pipeline makeGraphicsPipeline(const Device& device, const BindingLayout& layout,
                              const GraphicsPipelineInfo& want) {
  const SpecializationInfo specialization(want.specialization);
  const std::pair<VkShaderStageFlagBits, std::string_view> shaders[] = {
      {VK_SHADER_STAGE_VERTEX_BIT, want.vertexShader},
      {VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT, want.tessellationShaders[0]},
      {VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT, want.tessellationShaders[1]},
      {VK_SHADER_STAGE_GEOMETRY_BIT, want.geometryShader},
      {VK_SHADER_STAGE_FRAGMENT_BIT, want.fragmentShader}};
  std::vector<ShaderModule> modules;
  std::vector<VkPipelineShaderStageCreateInfo> stages;
  for (const auto& [bit, shader] : shaders)
    if (!shader.empty())
      stages.push_back(stage(bit, modules.emplace_back(makeModule(device, shader)), specialization));
  const bool tessellates = !want.tessellationShaders[0].empty();

  VkPipelineVertexInputStateCreateInfo input{.sType =
                                                 VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  input.vertexBindingDescriptionCount = static_cast<std::uint32_t>(want.vertexBindings.size());
  input.pVertexBindingDescriptions = want.vertexBindings.data();
  input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(want.vertexAttributes.size());
  input.pVertexAttributeDescriptions = want.vertexAttributes.data();
  VkPipelineInputAssemblyStateCreateInfo assembly{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = tessellates ? VK_PRIMITIVE_TOPOLOGY_PATCH_LIST : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineTessellationStateCreateInfo tessellation{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_TESSELLATION_STATE_CREATE_INFO};
  tessellation.patchControlPoints = 3;
  VkPipelineViewportStateCreateInfo viewport{.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.depthClampEnable = want.depthClamp;
  raster.polygonMode = VK_POLYGON_MODE_FILL;
  raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo multisample{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  multisample.rasterizationSamples = want.samples;
  VkPipelineDepthStencilStateCreateInfo depth{.sType =
                                                  VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  depth.depthTestEnable = depth.depthWriteEnable = want.depth;
  depth.depthCompareOp = want.depthAlways ? VK_COMPARE_OP_ALWAYS : VK_COMPARE_OP_GREATER;
  VkPipelineColorBlendAttachmentState how{};
  how.colorWriteMask = 0xf;
  if (want.adds) {
    how.blendEnable = VK_TRUE;
    how.srcColorBlendFactor = how.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
    how.srcAlphaBlendFactor = how.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  }
  const std::vector<VkPipelineColorBlendAttachmentState> attachments(want.colourFormats.size(), how);
  VkPipelineColorBlendStateCreateInfo blend{.sType =
                                                VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = static_cast<std::uint32_t>(attachments.size());
  blend.pAttachments = attachments.data();
  const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                   VK_DYNAMIC_STATE_CULL_MODE};
  VkPipelineDynamicStateCreateInfo dynamic{.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = std::size(states);
  dynamic.pDynamicStates = states;
  VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = static_cast<std::uint32_t>(want.colourFormats.size());
  rendering.pColorAttachmentFormats = want.colourFormats.data();
  rendering.depthAttachmentFormat = want.depth ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_UNDEFINED;

  VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
  info.pNext = &rendering;
  info.stageCount = static_cast<std::uint32_t>(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pTessellationState = tessellates ? &tessellation : nullptr;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &multisample;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = layout.pipeline();
  VkPipeline pipeline;
  check(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "vkCreateGraphicsPipelines");
  return {device, pipeline};
}

Sampler makeSampler(const Device& device, VkFilter filter) {
  VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = info.minFilter = filter;
  info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  VkSampler sampler;
  check(vkCreateSampler(device, &info, nullptr, &sampler), "vkCreateSampler");
  return {device, sampler};
}

Sampler makeLevelSampler(const Device& device) {
  VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = info.minFilter = VK_FILTER_LINEAR;
  info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.maxLod = VK_LOD_CLAMP_NONE;
  VkSampler sampler;
  check(vkCreateSampler(device, &info, nullptr, &sampler), "vkCreateSampler");
  return {device, sampler};
}

}  // namespace sundial
