#include "shadow/frame_pipelines.h"

#include "shadow/scene_buffers.h"

namespace sundial {

namespace {

GraphicsPipelineInfo geometry(std::string_view vertex, std::string_view fragment, bool ids, bool masked) {
  return {.vertexShader = vertex,
          .fragmentShader = fragment,
          .vertexBindings = SceneBuffers::vertexBindings(masked),
          .vertexAttributes = SceneBuffers::vertexAttributes(ids, masked),
          .colourFormats = ids ? std::vector{VK_FORMAT_R32G32_UINT} : std::vector<VkFormat>{},
          .depth = true,
          .depthClamp = !ids};
}

GraphicsPipelineInfo fullscreen(std::string_view fragment, std::vector<VkFormat> formats,
                                Specialization specialization = {}) {
  return {.vertexShader = "fullscreen.vert",
          .fragmentShader = fragment,
          .specialization = std::move(specialization),
          .colourFormats = std::move(formats)};
}

std::map<Volume, Pipeline> makePlanSingle(const Device& device, const BindingLayout& layout) {
  std::map<Volume, Pipeline> out;
  for (const Volume volume : {Volume::scene, Volume::samples})
    out.emplace(volume, makeComputePipeline(device, layout, "plan_single.comp",
                                            {volume == Volume::samples ? 1u : 0u}));
  return out;
}

std::map<Lookup, Pipeline> makeResolve(const Device& device, const BindingLayout& layout) {
  std::map<Lookup, Pipeline> out;
  for (const auto& [lookup, shader] :
       {std::pair(Lookup::hard, "lookup_hard.frag"), {Lookup::pcf, "lookup_pcf.frag"}})
    out.emplace(lookup, makeGraphicsPipeline(device, layout, fullscreen(shader, {VK_FORMAT_R32_SFLOAT})));
  return out;
}

}  // namespace

FramePipelines::FramePipelines(const Device& device)
    : layout(device),
      gbuffer(makeGraphicsPipeline(device, layout, geometry("gbuffer.vert", "gbuffer.frag", true, false))),
      gbufferMasked(makeGraphicsPipeline(device, layout,
                                         geometry("gbuffer_masked.vert", "gbuffer_masked.frag", true, true))),
      samples(makeGraphicsPipeline(
          device, layout,
          fullscreen("samples.frag", {VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32B32A32_UINT}))),
      analyzeBounds(makeComputePipeline(device, layout, "analyze_bounds.comp")),
      planSingle(makePlanSingle(device, layout)),
      cullTest(makeComputePipeline(device, layout, "cull_test.comp")),
      cullWrite(makeComputePipeline(device, layout, "cull_write.comp")),
      storeDepth(makeGraphicsPipeline(device, layout, geometry("store_depth.vert", "", false, false))),
      storeDepthMasked(makeGraphicsPipeline(
          device, layout, geometry("store_depth_masked.vert", "store_depth_masked.frag", false, true))),
      resolve(makeResolve(device, layout)),
      answers(
          makeGraphicsPipeline(device, layout, fullscreen("answers.frag", {VK_FORMAT_R32G32B32A32_UINT}))),
      shade(makeGraphicsPipeline(device, layout,
                                 fullscreen("shade.frag", {VK_FORMAT_R8G8B8A8_UNORM}, {VK_FALSE}))),
      shadePlain(makeGraphicsPipeline(device, layout,
                                      fullscreen("shade.frag", {VK_FORMAT_R8G8B8A8_UNORM}, {VK_TRUE}))) {}

}  // namespace sundial
