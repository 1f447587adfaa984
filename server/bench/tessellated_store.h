// A warped map as the papers draw it: by the graphics pipeline, which cuts triangles up where they are long
// in the map, and warps the corners of the pieces [NOTW, section 4.1; Rosen 2012]. Measured here beside the
// compute rasteriser's inverse, which frames use.
#pragma once

#include "shadow/depth_store.h"

namespace sundial::bench {

class TessellatedStore final : public DepthStore {
 public:
  // A method with a warp and raster=pipeline, on a device that has tessellation shaders. Edges are cut into
  // pieces of about so many texels, but into no more than tessellate.glsl allows.
  TessellatedStore(const Device&, FramePipelines&, const Method&, const shared::FrameConstants&,
                   std::uint32_t texelsPerPiece);

  std::optional<std::array<VkPipeline, 2>> pipelines() const override {
    return std::array<VkPipeline, 2>{opaque_, masked_};
  }

 private:
  Pipeline opaque_, masked_;
};

// As makeStore.
template <std::uint32_t texelsPerPiece>
std::unique_ptr<Store> makeTessellated(const Device& device, FramePipelines& pipelines, const Method& method,
                                       const shared::FrameConstants& constants) {
  return std::make_unique<TessellatedStore>(device, pipelines, method, constants, texelsPerPiece);
}

}  // namespace sundial::bench
