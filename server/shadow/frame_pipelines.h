// The pipelines of a frame, made once for a device: one a pass and stage choice.
#pragma once

#include <array>
#include <map>
#include <string>

#include "gpu/pipeline.h"
#include "shadow/method.h"
#include "shared/raster.h"

namespace sundial {

// What the stages' choices select.
struct MethodPipelines {
  VkPipeline plan;
  VkPipeline store, storeMasked;
  VkPipeline storeClear = VK_NULL_HANDLE;  // resolution=estimated, storage=depth
  VkPipeline resolve, answers;
  VkPipeline resolveFirst = VK_NULL_HANDLE;  // lookup=spsm, before `resolve`
  // Where samples are asked, depth is cut, or tiles are fitted to casters.
  VkPipeline analyzeSquare = VK_NULL_HANDLE;
  VkPipeline analyzeDepths = VK_NULL_HANDLE, analyzeSplits = VK_NULL_HANDLE;
  VkPipeline analyzeSegments = VK_NULL_HANDLE, analyzeCasters = VK_NULL_HANDLE;
  VkPipeline analyzeSizes = VK_NULL_HANDLE;  // a percentile of the pixels' sizes alone
  // storage=moments alone.
  VkPipeline moments = VK_NULL_HANDLE, blurAcross = VK_NULL_HANDLE, blurDown = VK_NULL_HANDLE;
};

// What the compute rasteriser does to a texel, in the numbers of shared/raster.h.
struct RasterChoice {
  bool ids = false;   // 64 bits a texel, depth and triangle, instead of 32 of depth
  bool sums = false;  // 32 bits a texel, of a sum over all triangles: tests alone
  std::uint32_t coverage = shared::kCoverCentre;
  Warp warp = Warp::none;  // with centre coverage, without ids
  bool cube = false;       // the warp's maps are a cube's
};

// Its rounds, for opaque and for masked triangles.
struct RasterPipelines {
  struct Kind {
    VkPipeline clusters = VK_NULL_HANDLE, listed = VK_NULL_HANDLE, bands = VK_NULL_HANDLE;
  };
  VkPipeline begin = VK_NULL_HANDLE;
  std::array<Kind, shared::kRasterKinds> kinds{};
};

// Of a warp; those of two do the rows and then the columns.
struct WarpPipelines {
  VkPipeline importance;                  // rectilinear alone; of samples, or of the light's map
  std::array<VkPipeline, 2> smooth;       // rectilinear alone: across, and down
  std::array<VkPipeline, 2> count, pool;  // non-orthogonal alone
  std::array<VkPipeline, 2> functions;
  VkPipeline bounds, centres;  // bounds: non-orthogonal alone
};

class FramePipelines {
 public:
  explicit FramePipelines(const Device&);

  // Made when they are first asked for. A method with a map; one without has no pipelines of its own.
  // `holes`: whether the scene is alpha-tested somewhere.
  MethodPipelines of(const Method&, bool holes = false);
  // How lookup=spsm answers, in the numbers of shared/choices.h, in the place of what it answers.
  VkPipeline classify(const Method&, bool holes);
  VkPipeline want(const Method&);  // storage=triangle: lists the texels that its lookups begin with
  RasterPipelines raster(const RasterChoice&, bool opaque, bool masked);
  WarpPipelines warp(const Method&);
  // The same for passes beside the stages.
  VkPipeline compute(std::string_view shader, const Specialization&);
  VkPipeline fullscreen(std::string_view shader, VkFormat, const Specialization&);
  VkPipeline volume(std::string_view vertex);  // faces of shadow volumes, counted

  BindingLayout layout;
  Pipeline gbuffer, gbufferMasked, samples;
  Pipeline cullTest, cullWrite;
  Pipeline shade, shadePlain;  // plain: a scene without textures and vertex colours
  TexelBuffer tables;          // lookup_tables.h

 private:
  // Told apart by their shaders and constants.
  VkPipeline drawing(GraphicsPipelineInfo, const Specialization& = {});

  const Device& device_;
  Pipeline storeDepth_, storeDepthMasked_;
  std::map<std::pair<std::string, Specialization>, Pipeline> variants_;  // by shader
};

}  // namespace sundial
