// The colour of a shadow view, the same in every picture that shows which one answered.
#pragma once

#include <cstddef>

#include "image/picture.h"

namespace sundial::image {

// Okabe and Ito's hues without grey, which is for no view; ordered so that the first four differ for any
// colour vision. From the eighth view on they return lighter, from the fifteenth on darker, and so around.
Rgb viewColour(std::size_t view);

}  // namespace sundial::image
