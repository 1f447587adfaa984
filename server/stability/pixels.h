// The pixels of a frame, in the place of points: what they show, and whether it is the truth.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/reference.h"
#include "shadow/view_target.h"
#include "shared/frame.h"

namespace sundial {

// Of a target whose view samples are there: one a pixel, row by row.
std::vector<shared::ViewSample> samplesIn(const Device&, const ViewTarget&);

struct PixelCount {
  std::uint64_t seen = 0;   // show geometry
  std::uint64_t wrong = 0;  // of them: the visibility in the target, rounded at one half, isn't the rays'
};

// The light is unit, `origin` as in Reference.
PixelCount countPixels(const Device&, const ViewTarget&, const Reference&, const Light&,
                       const glm::dvec3& origin);

}  // namespace sundial
