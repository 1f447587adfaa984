// Draws shadow maps into a linear buffer by compute shaders (shaders/raster.glsl): the clusters that culling
// left for each view, whatever the views' sizes.
#pragma once

#include "gpu/resource.h"
#include "shadow/frame_pipelines.h"
#include "shared/frame.h"
#include "shared/raster.h"

namespace sundial {

class Rasteriser {
 public:
  // Of `views` views of the scene whose buckets these are.
  Rasteriser(const Device&, FramePipelines&, const RasterChoice&, std::uint32_t views,
             const shared::FrameConstants&);

  void bindTo(BindingSet&) const;
  // Into the buffer at kBindLinear, which is cleared; bindings are bound. Commands and counts are those of
  // slot 1 on.
  void record(VkCommandBuffer) const;

  // What the recorded work found, once it is done.
  bool overflowed() const;
  // Room for as much as was asked for; then everything is to be bound and recorded again. Throws GpuError
  // where that is more than a buffer holds.
  void makeRoom();
  std::uint64_t triangles() const { return found().triangles; }
  std::uint64_t bytes() const;

 private:
  // Entries of each kind.
  struct Room {
    std::uint32_t listed, parts, bands;
  };
  void allocate(const Room&);
  const shared::RasterState& found() const { return *host_.mapped<shared::RasterState>(); }

  const Device& device_;
  VkPipelineLayout layout_;
  RasterPipelines pipelines_;
  std::uint32_t views_;
  std::array<bool, shared::kBuckets> filled_{};  // the buckets that hold anything
  Room room_{};
  Buffer state_, host_, listed_, parts_, bands_;
};

}  // namespace sundial
