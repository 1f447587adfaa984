// Numbers written into pictures, where no font is at hand.
#pragma once

#include "image/picture.h"

namespace sundial::image {

// Pixels that a number takes at a scale of 1: glyphs of 5 x 7, one apart, and an outline of one around them.
struct NumberSize {
  unsigned width, height;
};
NumberSize numberSize(unsigned number);

// White in a black outline, centred there; what lies outside of the picture (RGB) is cut off. A glyph's dot
// is `scale` pixels a side.
void drawNumber(Picture&, unsigned number, int centreX, int centreY, unsigned scale);

}  // namespace sundial::image
