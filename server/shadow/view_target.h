// What a view is rendered into: images and view samples of one size, shared by all methods.
#pragma once

#include <glm/glm.hpp>

#include "gpu/pipeline.h"

namespace sundial {

class ViewTarget {
 public:
  ViewTarget(const Device&, glm::uvec2 size);

  glm::uvec2 size() const { return {depth.extent().width, depth.extent().height}; }
  void bindTo(BindingSet&) const;
  VkDeviceSize bytes() const;

  GpuImage depth;       // D32, reversed
  GpuImage ids;         // RG32UI: draw, triangle
  GpuImage visibility;  // R32F
  GpuImage undecided;   // D32: 0 where the first round of a lookup left the answer to the second
  GpuImage colour;      // RGBA8, sRGB
  // The view samples, two RGBA32UI images (a buffer would pass lavapipe's limit of 128 MiB at 2048 x 2048):
  GpuImage positions;  // the position's bits and the instance
  GpuImage normals;    // the normal's bits and the triangle
  GpuImage answers;    // shared::Answer as RGBA32UI

 private:
  Sampler nearest_;
};

}  // namespace sundial
