// Which shadow view answered where, over the shaded picture.
#pragma once

#include "image/picture.h"

namespace sundial::image {

// The picture's lightness in the colour of the view that answered (viewColour); dim and grey where none did,
// because nothing is there, it faces away from the light or lies outside of all maps. Each view's number is
// written where its region is widest, if it fits. Both images have one size.
Picture viewTint(const client::Image& colour, const client::Image& view);

}  // namespace sundial::image
