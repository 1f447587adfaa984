// Where shadows flip: frames of a path side by side.
#pragma once

#include <vector>

#include "image/picture.h"
#include "sundial/stability.h"

namespace sundial::image {

// In the colours of errors: sky blue for a point that became lit, vermillion for one that fell into shadow.
inline constexpr Rgb kBecameLit = {0x56, 0xb4, 0xe9};
inline constexpr Rgb kBecameDark = {0xd5, 0x5e, 0x00};

inline constexpr unsigned kStripSide = 256;  // pixels: the longer side of a frame in a strip, at most
inline constexpr unsigned kStripGap = 4;     // black, between frames

// The frames dimmed and grey, each flipped point a disc. All pictures have one size, and there is at least
// one.
Picture flipStrip(const std::vector<client::StabilityPicture>&);

}  // namespace sundial::image
