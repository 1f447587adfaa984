#include "image/class_tint.h"

#include <algorithm>

namespace sundial::image {

namespace {
constexpr std::uint32_t kNone = 0xffffffff, kNeighbours = 2, kRebuilt = 3;
}

Rgb classColour(std::uint32_t found) {
  if (found == kNeighbours) return {0x00, 0x9e, 0x73};  // bluish green
  if (found == kRebuilt) return {0xd5, 0x1e, 0x00};
  return {90, 90, 90};
}

bool hasClasses(const client::Image& classes) {
  return std::ranges::any_of(numbersOf<std::uint32_t>(classes),
                             [](std::uint32_t found) { return found != kNone; });
}

Picture classTint(const client::Image& colour, const client::Image& classes) {
  Picture picture = toPicture(colour);
  const auto found = numbersOf<std::uint32_t>(classes);
  for (std::size_t i = 0; i < found.size() && 3 * i + 2 < picture.pixels.size(); ++i) {
    if (found[i] != kNeighbours && found[i] != kRebuilt) continue;
    const Rgb tint = classColour(found[i]);
    std::uint8_t* pixel = &picture.pixels[3 * i];
    pixel[0] = static_cast<std::uint8_t>((pixel[0] + 2 * tint.r) / 3);
    pixel[1] = static_cast<std::uint8_t>((pixel[1] + 2 * tint.g) / 3);
    pixel[2] = static_cast<std::uint8_t>((pixel[2] + 2 * tint.b) / 3);
  }
  return picture;
}

}  // namespace sundial::image
