// Counts flips: answers that change from one frame to the next although the truth doesn't.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "stability/stability.h"

namespace sundial {

// What is known of a point in a frame: bits.
using PointState = std::uint8_t;
inline constexpr PointState kPointSeen = 1;      // by the camera
inline constexpr PointState kPointBack = 2;      // from the side that its normal turns away from
inline constexpr PointState kPointLit = 4;       // says the method
inline constexpr PointState kPointTruthLit = 8;  // says the reference

class FlipCounter {
 public:
  // The next frame's states, one a point, always of as many points.
  // A point counts where it is seen in this frame and the one before, from the same side both times.
  StabilityFrame add(std::span<const PointState> states);

  // Points that flipped in the frame added last, ascending.
  const std::vector<std::uint32_t>& flipped() const { return flipped_; }

 private:
  std::vector<PointState> before_;
  std::vector<std::uint32_t> flipped_;
  unsigned frames_ = 0;
};

// The rates that follow from the frames: all of a result but its method and points.
StabilityResult summed(std::vector<StabilityFrame> frames);

}  // namespace sundial
