#include "bench/tessellated_store.h"

#include "shadow/scene_buffers.h"
#include "shared/choices.h"

namespace sundial::bench {

namespace {

Pipeline makePipeline(const Device& device, const BindingLayout& layout, Warp warp,
                      std::uint32_t texelsPerPiece, bool masked) {
  const std::uint32_t chosen =
      warp == Warp::rectilinear ? shared::kWarpRectilinear : shared::kWarpNonOrthogonal;
  GraphicsPipelineInfo info{.vertexShader = "store_depth.vert",
                            .fragmentShader = "",
                            .specialization = {texelsPerPiece, 0, 0, 0, 0, 0, 0,
                                               chosen},  // as tessellate.glsl and warp.glsl number them
                            .vertexBindings = SceneBuffers::vertexBindings(masked),
                            .vertexAttributes = SceneBuffers::vertexAttributes(false, masked),
                            .depth = true,
                            .depthClamp = true,
                            .tessellationShaders = {"store_tessellated.tesc", "store_tessellated.tese"}};
  if (masked) {
    info.vertexShader = "store_depth_masked.vert";
    info.fragmentShader = "store_depth_masked.frag";
    info.tessellationShaders = {"store_tessellated_masked.tesc", "store_tessellated_masked.tese"};
  }
  return makeGraphicsPipeline(device, layout, info);
}

}  // namespace

TessellatedStore::TessellatedStore(const Device& device, FramePipelines& pipelines, const Method& method,
                                   const shared::FrameConstants& constants, std::uint32_t texelsPerPiece)
    : DepthStore(device, pipelines, method, constants),
      opaque_(makePipeline(device, pipelines.layout, method.stages->warp, texelsPerPiece, false)),
      masked_(makePipeline(device, pipelines.layout, method.stages->warp, texelsPerPiece, true)) {}

}  // namespace sundial::bench
