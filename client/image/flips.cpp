#include "image/flips.h"

#include <algorithm>
#include <cmath>

namespace sundial::image {
namespace {

constexpr float kDisc = 2.2f, kOutline = 3.2f;  // radii, pixels of the strip

// The mean luma of a square of `scale` pixels of the picture, dimmed.
std::uint8_t dimmed(const client::StabilityPicture& from, unsigned x, unsigned y, unsigned scale) {
  const auto* pixels = reinterpret_cast<const unsigned char*>(from.rgba.data());
  unsigned sum = 0, count = 0;
  for (unsigned v = y * scale; v < std::min((y + 1) * scale, from.about.height()); ++v)
    for (unsigned u = x * scale; u < std::min((x + 1) * scale, from.about.width()); ++u, ++count) {
      const unsigned char* p = pixels + 4 * (std::size_t{v} * from.about.width() + u);
      sum += (54u * p[0] + 183u * p[1] + 19u * p[2]) / 256;  // Rec. 709
    }
  return static_cast<std::uint8_t>(count == 0 ? 0 : sum / count * 11 / 20);
}

void drawDisc(Picture& strip, unsigned left, unsigned width, float x, float y, Rgb colour) {
  const int reach = static_cast<int>(std::ceil(kOutline));
  for (int v = static_cast<int>(y) - reach; v <= static_cast<int>(y) + reach; ++v)
    for (int u = static_cast<int>(x) - reach; u <= static_cast<int>(x) + reach; ++u) {
      if (u < 0 || v < 0 || u >= static_cast<int>(width) || v >= static_cast<int>(strip.height)) continue;
      const float distance = std::hypot(static_cast<float>(u) + 0.5f - x, static_cast<float>(v) + 0.5f - y);
      if (distance > kOutline) continue;
      const Rgb shown = distance > kDisc ? Rgb{0, 0, 0} : colour;
      std::uint8_t* pixel =
          &strip.pixels[3 * (static_cast<std::size_t>(v) * strip.width + left + static_cast<unsigned>(u))];
      pixel[0] = shown.r;
      pixel[1] = shown.g;
      pixel[2] = shown.b;
    }
}

}  // namespace

Picture flipStrip(const std::vector<client::StabilityPicture>& frames) {
  const unsigned wide = frames.front().about.width(), high = frames.front().about.height();
  const unsigned scale = (std::max(wide, high) + kStripSide - 1) / kStripSide;
  const unsigned width = (wide + scale - 1) / scale, height = (high + scale - 1) / scale;
  const auto count = static_cast<unsigned>(frames.size());
  Picture strip{count * (width + kStripGap) - kStripGap, height, 3, {}};
  strip.pixels.resize(std::size_t{3} * strip.width * strip.height);
  for (unsigned i = 0; i < count; ++i) {
    const unsigned left = i * (width + kStripGap);
    for (unsigned y = 0; y < height; ++y)
      for (unsigned x = 0; x < width; ++x)
        std::fill_n(&strip.pixels[3 * (std::size_t{y} * strip.width + left + x)], 3,
                    dimmed(frames[i], x, y, scale));
    for (const v1::FlippedPoint& point : frames[i].about.flipped())
      drawDisc(strip, left, width, point.x() / static_cast<float>(scale),
               point.y() / static_cast<float>(scale), point.lit() ? kBecameLit : kBecameDark);
  }
  return strip;
}

}  // namespace sundial::image
