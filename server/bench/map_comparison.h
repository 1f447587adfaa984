// Maps of several frames: how long they take to draw, and where they differ.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "shadow/frame.h"

namespace sundial::bench {

// Wall-clock milliseconds around one pass of each frame, or all of them, run by run in turn; all frames ran
// once before.
std::vector<std::vector<double>> storeTimes(const Device&, const std::vector<Frame*>&, int runs);
std::vector<std::vector<double>> frameTimes(const Device&, const std::vector<Frame*>&, int runs);
// The median of pairs from the same run.
double ratio(const std::vector<double>& of, const std::vector<double>& to);

// Whether two depths of a view, in [0, 1], differ.
using Differ = std::function<bool(const shared::ShadowView&, float, float)>;
inline bool differSlightly(const shared::ShadowView&, float a, float b) { return std::abs(a - b) > 1e-4f; }

// What a map drawn by compute has against the pipeline's.
struct Differences {
  std::size_t covered = 0, missing = 0, added = 0;  // texels
  std::size_t far = 0;                              // that differ, where both cover something
  // At the near plane by the pipeline alone: it divides by the area of a triangle that has none in floats,
  // and what is no number counts as the nearest. Not in `far`.
  std::size_t byZero = 0;
};
// Of a frame that keeps its maps in an image and one that keeps them in a buffer; both have run.
Differences differences(const Frame& image, const Frame& linear, const Differ& differ = differSlightly);

}  // namespace sundial::bench
