// A sight on the device, as frames of several methods see it.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "bench/place.h"
#include "shadow/frame.h"

namespace sundial::bench {

class FrameScene {
 public:
  FrameScene(const Device&, FramePipelines&, Sight, glm::uvec2 size);

  // That ran once. Throws std::runtime_error.
  std::unique_ptr<Frame> frame(const Method&, MakeStore* make = makeStore) const;
  std::unique_ptr<Frame> frame(std::string_view method, MakeStore* make = makeStore) const;

  const Device& device() const { return device_; }
  shared::FrameConstants constants() const;  // of the camera and the light, before a method's
  // Of the frames that ran: their view samples, one a pixel, relative to the frames' origin; how they are
  // lit, by rays; and 1 for those that face the light.
  std::vector<shared::ViewSample> samples() const;
  std::vector<float> reference() const;
  std::vector<std::uint8_t> facing() const;
  // Of the last of them: how lit each pixel is.
  std::vector<float> visibility() const;

 private:
  const Device& device_;
  FramePipelines& pipelines_;
  Sight sight_;
  glm::dvec3 origin_;
  ViewTarget target_;
  SceneBuffers buffers_;
};

}  // namespace sundial::bench
