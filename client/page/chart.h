// The chart of error against time: both axes logarithmic, one mark a method.
#pragma once

#include <string>
#include <vector>

namespace sundial::page {

struct ChartPoint {
  std::string label;                // "sm,texels=1024"
  std::string family;               // points of one family are joined in order of time: "sm"
  double ms = 0;                    // median frame time, > 0
  double lowerMs = 0, upperMs = 0;  // its quartiles
  double wrong = 0;                 // share of pixels with geometry, [0, 1]; 0 lies in a band of its own
};

// An SVG element that takes its colours from the reader's light or dark scheme; also a file by itself.
std::string errorChart(const std::vector<ChartPoint>&);

}  // namespace sundial::page
