#include "bench/fragment_store.h"

#include <algorithm>

#include "gpu/rendering.h"
#include "shadow/plan_settings.h"
#include "shadow/scene_buffers.h"
#include "shared/bindings.h"

namespace sundial::bench {

namespace {

// Each map in a viewport of its own: the plan says where in the buffer it begins.
std::vector<VkRect2D> viewportsOf(const Method& method) {
  std::vector<VkRect2D> maps;
  for (const glm::uvec2& size : mapSizesOf(method)) maps.push_back({{0, 0}, {size.x, size.y}});
  return maps;
}

Pipeline makeConservative(const Device& device, const BindingLayout& layout) {
  return makeGraphicsPipeline(device, layout,
                              {.vertexShader = "store_depth.vert",
                               .fragmentShader = "store_conservative.frag",
                               .vertexBindings = SceneBuffers::vertexBindings(false),
                               .vertexAttributes = SceneBuffers::vertexAttributes(false, false),
                               .geometryShader = "conservative.geom"});
}

Pipeline makePipeline(const Device& device, const BindingLayout& layout, bool masked) {
  return makeGraphicsPipeline(device, layout,
                              {.vertexShader = masked ? "store_depth_masked.vert" : "store_depth.vert",
                               .fragmentShader = masked ? "store_linear_masked.frag" : "store_linear.frag",
                               .vertexBindings = SceneBuffers::vertexBindings(masked),
                               .vertexAttributes = SceneBuffers::vertexAttributes(false, masked),
                               .depthClamp = true});
}

}  // namespace

FragmentStore::FragmentStore(const Device& device, const FramePipelines& pipelines, const Method& method,
                             bool conservative)
    : device_(device),
      maps_(viewportsOf(method)),
      texels_(texelsOf(mapSizesOf(method))),
      depths_(device,
              Buffer(device, texels_ * sizeof(float),
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT),
              VK_FORMAT_R32_UINT, sizeof(float)),
      unread_(device, {1, 1}, VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_SAMPLED_BIT),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)),
      opaque_(conservative ? makeConservative(device, pipelines.layout)
                           : makePipeline(device, pipelines.layout, false)),
      masked_(makePipeline(device, pipelines.layout, true)) {
  device.submit([&](VkCommandBuffer command) {
    transition(command, unread_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

void FragmentStore::record(VkCommandBuffer command, const DrawView& draw) const {
  vkCmdFillBuffer(command, static_cast<const Buffer&>(depths_), 0, VK_WHOLE_SIZE, 0);
  barrier(command);
  VkExtent2D largest{1, 1};
  for (const VkRect2D& map : maps_)
    largest = {std::max(largest.width, map.extent.width), std::max(largest.height, map.extent.height)};
  renderNowhere(command, largest, [&] { drawMaps(command, maps_, draw); });
  barrier(command);
}

std::vector<float> FragmentStore::depths() const { return valuesOf<float>(downloaded(device_, depths_)); }

void FragmentStore::bindTo(BindingSet& bindings) const { bindNoStore(bindings, unread_, nearest_, depths_); }

}  // namespace sundial::bench
