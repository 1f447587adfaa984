#include "image/overlay.h"

#include <algorithm>

namespace sundial::image {
namespace {

enum class Verdict : std::uint8_t { right, falseLit, falseShadow };

// Visibility rounded at one half, as the measures have it.
std::vector<Verdict> judge(const client::Image& visibility, const client::Image& reference) {
  const auto s = numbersOf<float>(visibility), r = numbersOf<float>(reference);
  std::vector<Verdict> verdicts(std::min(s.size(), r.size()), Verdict::right);
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const bool lit = s[i] >= 0.5f, shouldBeLit = r[i] >= 0.5f;
    if (lit != shouldBeLit) verdicts[i] = lit ? Verdict::falseLit : Verdict::falseShadow;
  }
  return verdicts;
}

Rgb colourOf(Verdict verdict) { return verdict == Verdict::falseLit ? kFalseLit : kFalseShadow; }

}  // namespace

Picture errorOverlay(const client::Image& colour, const client::Image& visibility,
                     const client::Image& reference) {
  Picture picture = toPicture(colour);
  const auto verdicts = judge(visibility, reference);
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    std::uint8_t* pixel = &picture.pixels[3 * i];
    const int luma = (54 * pixel[0] + 183 * pixel[1] + 19 * pixel[2]) / 256;  // Rec. 709
    const auto grey = static_cast<std::uint8_t>(luma * 9 / 20);
    const Rgb shown = verdicts[i] == Verdict::right ? Rgb{grey, grey, grey} : colourOf(verdicts[i]);
    pixel[0] = shown.r;
    pixel[1] = shown.g;
    pixel[2] = shown.b;
  }
  return picture;
}

Picture errorLayer(const client::Image& visibility, const client::Image& reference) {
  constexpr std::uint8_t kHalo = 190;  // of 255
  const auto verdicts = judge(visibility, reference);
  const auto width = static_cast<int>(visibility.width), height = static_cast<int>(visibility.height);
  Picture layer{visibility.width, visibility.height, 4, std::vector<std::uint8_t>(4 * verdicts.size())};
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * visibility.width + static_cast<std::size_t>(x);
  };
  const auto put = [&](int x, int y, Rgb colour, std::uint8_t alpha) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    std::uint8_t* pixel = &layer.pixels[4 * at(x, y)];
    if (pixel[3] >= alpha) return;
    pixel[0] = colour.r;
    pixel[1] = colour.g;
    pixel[2] = colour.b;
    pixel[3] = alpha;
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Verdict verdict = verdicts[at(x, y)];
      if (verdict == Verdict::right) continue;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          put(x + dx, y + dy, colourOf(verdict), dx == 0 && dy == 0 ? 255 : kHalo);
    }
  return layer;
}

}  // namespace sundial::image
