// Eight-bit pictures, and how the server's images are shown as such.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sundial/rendering.h"

namespace sundial::image {

struct Picture {
  unsigned width = 0, height = 0;    // pixels
  unsigned channels = 3;             // 1 grey, 3 RGB, 4 RGBA; sRGB
  std::vector<std::uint8_t> pixels;  // row 0 at the top, no padding
};

struct Rgb {
  std::uint8_t r, g, b;
};

// Okabe and Ito's palette, told apart by readers with any colour vision; grey in the place of black, which a
// dark page would swallow.
inline constexpr Rgb kOkabeIto[] = {{0x00, 0x72, 0xb2}, {0xe6, 0x9f, 0x00}, {0x00, 0x9e, 0x73},
                                    {0xcc, 0x79, 0xa7}, {0x56, 0xb4, 0xe9}, {0xd5, 0x5e, 0x00},
                                    {0xf0, 0xe4, 0x42}, {0x8a, 0x92, 0x9b}};
inline constexpr unsigned kOkabeItoCount = 8;

// An image's numbers. T is as wide as the contract's channel: float or std::uint32_t.
template <class T>
std::vector<T> numbersOf(const client::Image&);

// Colour as it is; visibility and reference grey; normals as 0.5 n + 0.5; positions as their fractions of a
// metre; ids and views in colours of their own, black where there is none.
Picture toPicture(const client::Image&);

}  // namespace sundial::image
