#include "image/view_colour.h"

#include <cmath>
#include <iterator>

namespace sundial::image {
namespace {

// Sky blue, yellow, purple, vermillion; green, orange, blue. Grey is for no view.
constexpr unsigned kOrder[] = {4, 6, 3, 5, 2, 1, 0};

Rgb towards(Rgb from, std::uint8_t to, double share) {
  const auto channel = [&](std::uint8_t c) {
    return static_cast<std::uint8_t>(std::lround(c + (to - c) * share));
  };
  return {channel(from.r), channel(from.g), channel(from.b)};
}

}  // namespace

Rgb viewColour(std::size_t view) {
  const Rgb hue = kOkabeIto[kOrder[view % std::size(kOrder)]];
  switch (view / std::size(kOrder) % 3) {
    case 1:
      return towards(hue, 255, 0.5);
    case 2:
      return towards(hue, 0, 0.4);
    default:
      return hue;
  }
}

}  // namespace sundial::image
