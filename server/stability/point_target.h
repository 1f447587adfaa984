// Points in the place of a view's samples, so that every lookup answers them as it answers pixels.
#pragma once

#include <span>
#include <vector>

#include "shadow/view_target.h"
#include "shared/frame.h"

namespace sundial {

class PointTarget {
 public:
  // Holds up to `count` points, count >= 1, as the pixels of an image that is nearly square.
  PointTarget(const Device&, std::uint32_t count);

  const ViewTarget& target() const { return target_; }

  // Host memory and its way to the device. Rows beyond the points hold none.
  void set(std::span<const shared::ViewSample>);
  void recordUpload(VkCommandBuffer) const;

  // How lit the points are that were set last, in [0, 1].
  std::vector<float> visibility(const Device&) const;

 private:
  ViewTarget target_;
  Buffer positions_, normals_;
  std::size_t points_ = 0;
};

}  // namespace sundial
