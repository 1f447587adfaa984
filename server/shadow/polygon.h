// Convex polygons that lines or planes cut.
#pragma once

#include <vector>

namespace sundial {

// Keeps what of a convex polygon has height(corner) >= 0, `height` being linear, and calls `cut` with every
// corner that is new [Sutherland and Hodgman 1974].
template <class Point, class Height, class Cut>
void clip(std::vector<Point>& polygon, const Height& height, const Cut& cut) {
  std::vector<Point> kept;
  kept.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double heightA = height(a), heightB = height(b);
    if (heightA >= 0) kept.push_back(a);
    if ((heightA >= 0) == (heightB >= 0)) continue;
    kept.push_back(a + (b - a) * (heightA / (heightA - heightB)));
    cut(kept.back());
  }
  polygon = std::move(kept);
}

template <class Point, class Height>
void clip(std::vector<Point>& polygon, const Height& height) {
  clip(polygon, height, [](const Point&) {});
}

}  // namespace sundial
