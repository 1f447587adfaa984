#include "page/density.h"

#include <algorithm>
#include <cmath>

namespace sundial::page {
namespace {

// Bright enough to see a lone sample, dim enough for colours and words over the densest cells.
constexpr image::Rgb kOne = {0x3a, 0x3f, 0x45}, kMost = {0xc4, 0xc8, 0xcc};

}  // namespace

image::Rgb densityGrey(double share) {
  const auto channel = [&](int from, int to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
  };
  return {channel(kOne.r, kMost.r), channel(kOne.g, kMost.g), channel(kOne.b, kMost.b)};
}

Density densityOf(const std::vector<glm::dvec2>& points, double side, unsigned cells) {
  std::vector<unsigned> counts(std::size_t{cells} * cells);
  Density density{{cells, cells, 3, {}}, 0};
  for (const glm::dvec2 point : points) {
    const glm::dvec2 at = glm::floor(point / side * static_cast<double>(cells));
    if (!(at.x >= 0 && at.y >= 0 && at.x < cells && at.y < cells)) continue;
    const std::size_t cell = static_cast<std::size_t>(at.y) * cells + static_cast<std::size_t>(at.x);
    density.most = std::max(density.most, ++counts[cell]);
  }
  const double decades = std::max(std::log(static_cast<double>(density.most)), 1e-9);
  for (const unsigned count : counts) {
    const image::Rgb grey =
        count == 0 ? kNoPoints : densityGrey(std::log(static_cast<double>(count)) / decades);
    density.picture.pixels.insert(density.picture.pixels.end(), {grey.r, grey.g, grey.b});
  }
  return density;
}

}  // namespace sundial::page
