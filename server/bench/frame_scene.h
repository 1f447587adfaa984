// A sight on the device, as frames of several methods see it.
#pragma once

#include <memory>
#include <string_view>

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
  const ViewTarget& target() const { return target_; }
  const Light& light() const { return sight_.light; }
  const glm::dvec3& origin() const { return origin_; }

 private:
  const Device& device_;
  FramePipelines& pipelines_;
  Sight sight_;
  glm::dvec3 origin_;
  ViewTarget target_;
  SceneBuffers buffers_;
};

}  // namespace sundial::bench
