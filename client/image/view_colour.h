// The colour of a shadow view, the same in every picture that shows which one answered.
#pragma once

#include <cstddef>

#include "image/picture.h"

namespace sundial::image {

// Okabe and Ito's hues, ordered so that the first four, and each and its next, differ for any colour vision
// on a dark ground. From the ninth view on they return lighter, from the seventeenth on darker, and so
// around.
Rgb viewColour(std::size_t view);

}  // namespace sundial::image
