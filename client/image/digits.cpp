#include "image/digits.h"

#include <string>

namespace sundial::image {
namespace {

constexpr unsigned kWidth = 5, kHeight = 7, kAdvance = kWidth + 1;

// Rows from the top; the highest of five bits is on the left.
constexpr std::uint8_t kGlyphs[10][kHeight] = {
    {0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110},
    {0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110},
    {0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111},
    {0b01110, 0b10001, 0b00001, 0b00110, 0b00001, 0b10001, 0b01110},
    {0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010},
    {0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110},
    {0b01110, 0b10000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110},
    {0b11111, 0b00001, 0b00010, 0b00010, 0b00100, 0b00100, 0b00100},
    {0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110},
    {0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00001, 0b01110},
};

void fill(Picture& picture, int x, int y, int side, std::uint8_t level) {
  for (int row = y; row < y + side; ++row)
    for (int column = x; column < x + side; ++column) {
      if (row < 0 || column < 0 || row >= static_cast<int>(picture.height) ||
          column >= static_cast<int>(picture.width))
        continue;
      std::uint8_t* pixel = &picture.pixels[3 * (std::size_t{picture.width} * static_cast<unsigned>(row) +
                                                 static_cast<unsigned>(column))];
      pixel[0] = pixel[1] = pixel[2] = level;
    }
}

}  // namespace

NumberSize numberSize(unsigned number) {
  const auto digits = static_cast<unsigned>(std::to_string(number).size());
  return {digits * kAdvance + 1, kHeight + 2};
}

void drawNumber(Picture& picture, unsigned number, int centreX, int centreY, unsigned scale) {
  const NumberSize size = numberSize(number);
  const int dot = static_cast<int>(scale);
  const int left = centreX - dot * static_cast<int>(size.width) / 2 + dot;
  const int top = centreY - dot * static_cast<int>(size.height) / 2 + dot;
  const std::string digits = std::to_string(number);
  for (const bool outline : {true, false})
    for (unsigned i = 0; i < digits.size(); ++i)
      for (unsigned y = 0; y < kHeight; ++y)
        for (unsigned x = 0; x < kWidth; ++x) {
          if ((kGlyphs[digits[i] - '0'][y] >> (kWidth - 1 - x) & 1) == 0) continue;
          const int atX = left + dot * static_cast<int>(i * kAdvance + x),
                    atY = top + dot * static_cast<int>(y);
          if (outline)
            fill(picture, atX - dot, atY - dot, 3 * dot, 0);
          else
            fill(picture, atX, atY, dot, 255);
        }
}

}  // namespace sundial::image
