// Which texels a triangle covers, in 64-bit integers and from the definition: the judge of the compute
// rasteriser (shaders/raster.glsl), and as slow as it is plain.
//
// Clipping and the way to the grid are floats, in the order of lavapipe's pipeline; from the grid on all is
// exact.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace sundial::test {

enum class Coverage {
  centre,        // the texel's centre lies inside, or on a left or a top edge
  conservative,  // the texel's square and the triangle touch
};

// A map within an image, texels.
struct MapRect {
  glm::uvec2 offset{0}, size{0};
};

using GridPoint = glm::i64vec2;  // 1/256 texels from the centre of the map's first texel
using GridTriangle = std::array<GridPoint, 3>;

inline constexpr std::int64_t kGrid = 256;
inline constexpr float kLeastW = 1e-30f;  // at the light itself there is nothing to divide by

inline std::int64_t cross(GridPoint a, GridPoint b) { return a.x * b.y - a.y * b.x; }

inline bool coversCentre(const GridTriangle& t, GridPoint centre) {
  for (int i = 0; i < 3; ++i) {
    const GridPoint along = t[(i + 1) % 3] - t[i];
    const std::int64_t side = cross(along, centre - t[i]);
    // The inside lies to the right of a left edge, and below a top edge.
    const bool isLeft = along.y < 0, isTop = along.y == 0 && along.x > 0;
    if (side < 0 || (side == 0 && !isLeft && !isTop)) return false;
  }
  return true;
}

// By the axes that could separate the two: the square's own, and one across each edge.
inline bool touchesSquare(const GridTriangle& t, GridPoint centre) {
  for (int axis = 0; axis < 2; ++axis) {
    const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
    if (high < centre[axis] - kGrid / 2 || low > centre[axis] + kGrid / 2) return false;
  }
  for (int i = 0; i < 3; ++i) {
    std::int64_t most = INT64_MIN;
    for (const int x : {-1, 1})
      for (const int y : {-1, 1})
        most = std::max(most, cross(t[(i + 1) % 3] - t[i], centre + GridPoint(x, y) * (kGrid / 2) - t[i]));
    if (most < 0) return false;
  }
  return true;
}

inline bool covers(GridTriangle t, glm::ivec2 texel, Coverage coverage) {
  if (cross(t[1] - t[0], t[2] - t[0]) < 0) std::swap(t[1], t[2]);
  const GridPoint centre = GridPoint(texel) * kGrid;
  return coverage == Coverage::centre ? coversCentre(t, centre) : touchesSquare(t, centre);
}

// What of a triangle lies inside the map's four sides, in clip space: a convex polygon.
inline std::vector<glm::vec4> clippedToMap(const std::array<glm::vec4, 3>& corners) {
  std::vector<glm::vec4> polygon(corners.begin(), corners.end());
  for (int side = 0; side < 4; ++side) {
    const auto distance = [&](const glm::vec4& p) {
      return side % 2 == 0 ? p.w - p[side / 2] : p.w + p[side / 2];
    };
    std::vector<glm::vec4> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::vec4 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const float da = distance(a), db = distance(b);
      if (da >= 0) kept.push_back(a);
      if ((da >= 0) == (db >= 0)) continue;
      // From the nearer corner.
      const bool fromA = std::abs(da) < std::abs(db);
      const glm::vec4 &from = fromA ? a : b, &to = fromA ? b : a;
      const float t = fromA ? -da / (db - da) : -db / (da - db);
      kept.push_back(from + t * (to - from));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

inline GridPoint onGrid(const glm::vec4& clip, const MapRect& map) {
  const float perW = 1 / clip.w;
  const glm::vec2 half = 0.5f * glm::vec2(map.size);
  // The multiplication isn't rounded before the addition.
  const glm::vec2 ndc = glm::vec2(clip) * perW, centre = glm::vec2(map.offset) + half;
  const glm::vec2 window(std::fma(ndc.x, half.x, centre.x), std::fma(ndc.y, half.y, centre.y));
  // Where a triangle's plane passes the light, clipping leaves corners that rounding carries far outside.
  const glm::vec2 low = glm::vec2(map.offset) - 0.5f, high = glm::vec2(map.offset + map.size) + 0.5f;
  const glm::vec2 grid = (glm::clamp(window, low, high) - 0.5f) * static_cast<float>(kGrid);
  return GridPoint(std::nearbyint(grid.x), std::nearbyint(grid.y)) - GridPoint(map.offset) * kGrid;
}

// Calls visit(texel) for each that the triangle covers; of a clipped triangle, for each of its parts that
// covers it.
template <class Visit>
void rasterise(const std::array<glm::vec4, 3>& corners, const MapRect& map, Coverage coverage, Visit visit) {
  const std::vector<glm::vec4> polygon = clippedToMap(corners);
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    if (!(std::min({polygon[0].w, polygon[i - 1].w, polygon[i].w}) > kLeastW)) continue;
    const GridTriangle t{onGrid(polygon[0], map), onGrid(polygon[i - 1], map), onGrid(polygon[i], map)};
    glm::i64vec2 low = glm::min(glm::min(t[0], t[1]), t[2]) / kGrid - std::int64_t{1};
    glm::i64vec2 high = glm::max(glm::max(t[0], t[1]), t[2]) / kGrid + std::int64_t{1};
    low = glm::max(low, glm::i64vec2(0));
    high = glm::min(high, glm::i64vec2(map.size) - std::int64_t{1});
    for (std::int64_t y = low.y; y <= high.y; ++y)
      for (std::int64_t x = low.x; x <= high.x; ++x)
        if (covers(t, glm::ivec2(x, y), coverage)) visit(glm::uvec2(x, y));
  }
}

}  // namespace sundial::test
