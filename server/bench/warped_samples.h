// How a warp spreads view samples over its maps: its tables, read back from the device, applied on the host.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/frame_scene.h"

namespace sundial::bench {

// Of one map. Positions are in texels of the map, from (0, 0) to its size; functions are those of
// shaders/warp.glsl.
struct Warped {
  glm::uvec2 size{0};
  bool empty = false;                 // no sample lies in it, and there are no tables
  std::size_t rows = 1, columns = 1;  // functions across and down
  std::vector<float> values;          // of functions, those across, then those down
  std::vector<glm::vec2> centres;     // where texels' came from; with one function across, first x, then y
  std::vector<glm::dvec2> samples;    // of pixels that face the light, before the warp

  const float* across(std::size_t row) const { return &values[row * (size.x + 1)]; }
  const float* down(std::size_t column) const { return across(rows) + column * (size.y + 1); }
  glm::dvec2 centre(unsigned x, unsigned y) const;      // of a texel after the warp: where it came from
  glm::dvec2 operator()(const glm::dvec2& from) const;  // where a position goes
};

// Of each map of a frame with a warp. A pixel is cut into side * side, with a sample for each on the plane of
// its surface: many tell how much of the picture lies in a texel, where the pixels' own grid, at two or three
// of them to a texel, would be the most that varies. Throws std::runtime_error.
std::vector<Warped> warpedOf(const FrameScene&, const Method&, unsigned side = 1);

// Samples in each texel, row by row, before the warp and after it.
std::vector<double> countsBefore(const Warped&);
std::vector<double> countsAfter(const Warped&);
// Standard deviation over mean.
double variation(const std::vector<double>& counts);

}  // namespace sundial::bench
