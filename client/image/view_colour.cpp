#include "image/view_colour.h"

#include <cmath>

namespace sundial::image {
namespace {

// Sky blue, yellow, purple, vermillion; green, orange, blue, grey.
constexpr unsigned kOrder[kOkabeItoCount] = {4, 6, 3, 5, 2, 1, 0, 7};

Rgb towards(Rgb from, std::uint8_t to, double share) {
  const auto channel = [&](std::uint8_t c) {
    return static_cast<std::uint8_t>(std::lround(c + (to - c) * share));
  };
  return {channel(from.r), channel(from.g), channel(from.b)};
}

}  // namespace

Rgb viewColour(std::size_t view) {
  const Rgb hue = kOkabeIto[kOrder[view % kOkabeItoCount]];
  switch (view / kOkabeItoCount % 3) {
    case 1:
      return towards(hue, 255, 0.5);
    case 2:
      return towards(hue, 0, 0.4);
    default:
      return hue;
  }
}

}  // namespace sundial::image
