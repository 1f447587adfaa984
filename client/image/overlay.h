// Where a method is wrong.
#pragma once

#include "image/picture.h"

namespace sundial::image {

// Light on the dimmed picture, and apart in hue and in lightness for any colour vision.
inline constexpr Rgb kFalseLit = {0x56, 0xb4, 0xe9};     // sky blue: lit, should be in shadow
inline constexpr Rgb kFalseShadow = {0xd5, 0x5e, 0x00};  // vermillion: in shadow, should be lit

// The dimmed grey picture with every wrong pixel in its colour. All three images have one size.
Picture errorOverlay(const client::Image& colour, const client::Image& visibility,
                     const client::Image& reference);

// Only the wrong pixels, RGBA, the rest transparent; with a faint halo of a pixel so that a single one can be
// seen when the picture is shown smaller than it is.
Picture errorLayer(const client::Image& visibility, const client::Image& reference);

}  // namespace sundial::image
