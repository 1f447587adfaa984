#include "image/view_tint.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "image/digits.h"
#include "image/view_colour.h"

namespace sundial::image {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

// For each pixel the largest square around it of pixels of its own view has 2 n - 1 of them a side.
std::vector<int> distancesToRim(const std::vector<std::uint32_t>& views, int width, int height) {
  std::vector<int> distance(views.size());
  const auto at = [&](int x, int y) { return static_cast<std::size_t>(y) * width + x; };
  const auto through = [&](int x, int y, int dx, int dy) {
    if (x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height) return 1;
    const std::size_t there = at(x + dx, y + dy);
    return views[there] == views[at(x, y)] ? distance[there] + 1 : 1;
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      distance[at(x, y)] =
          std::min({through(x, y, -1, 0), through(x, y, -1, -1), through(x, y, 0, -1), through(x, y, 1, -1)});
  for (int y = height; y-- > 0;)
    for (int x = width; x-- > 0;)
      distance[at(x, y)] = std::min({distance[at(x, y)], through(x, y, 1, 0), through(x, y, 1, 1),
                                     through(x, y, 0, 1), through(x, y, -1, 1)});
  return distance;
}

void drawNumbers(Picture& picture, const std::vector<std::uint32_t>& views) {
  const auto width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  const std::vector<int> distance = distancesToRim(views, width, height);
  std::map<std::uint32_t, std::size_t> widest;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i] == kNone) continue;
    const auto [entry, isNew] = widest.try_emplace(views[i], i);
    if (!isNew && distance[i] > distance[entry->second]) entry->second = i;
  }
  const unsigned largest = std::max(2u, picture.height / 180);
  for (const auto& [view, place] : widest) {
    const NumberSize size = numberSize(view);
    const unsigned room = static_cast<unsigned>(2 * distance[place] - 1) / std::max(size.width, size.height);
    if (room == 0) continue;
    drawNumber(picture, view, static_cast<int>(place % picture.width),
               static_cast<int>(place / picture.width), std::min(largest, room));
  }
}

}  // namespace

Picture viewTint(const client::Image& colour, const client::Image& view) {
  Picture picture = toPicture(colour);
  const auto views = numbersOf<std::uint32_t>(view);
  for (std::size_t i = 0; i < views.size() && 3 * i + 2 < picture.pixels.size(); ++i) {
    std::uint8_t* pixel = &picture.pixels[3 * i];
    const double luma = (54 * pixel[0] + 183 * pixel[1] + 19 * pixel[2]) / 256.0 / 255;  // Rec. 709
    const Rgb tint = views[i] == kNone ? Rgb{90, 90, 90} : viewColour(views[i]);
    const double level = 0.25 + 0.75 * luma;  // shadows keep their view's colour
    pixel[0] = static_cast<std::uint8_t>(std::lround(tint.r * level));
    pixel[1] = static_cast<std::uint8_t>(std::lround(tint.g * level));
    pixel[2] = static_cast<std::uint8_t>(std::lround(tint.b * level));
  }
  drawNumbers(picture, views);
  return picture;
}

}  // namespace sundial::image
