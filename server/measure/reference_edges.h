// Where the true shadow has its edges in the image.
#pragma once

#include <cstdint>
#include <vector>

#include "measure/measures.h"

namespace sundial {

// 1 for each pixel of Omega that has one of its four neighbours in Omega too, continues it in depth and
// differs from it in R (rounded at one half); else 0. Both sides of an edge are edge pixels. Facing away is R
// = 0 like any shadow, so the line where a surface turns from the light is an edge.
std::vector<std::uint8_t> referenceEdges(const MeasureInput&);

}  // namespace sundial
