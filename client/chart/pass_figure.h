// Time of every pass, stacked: a bar a method.
#pragma once

#include <string>
#include <vector>

#include "chart/results.h"

namespace sundial::chart {

// Of all cases: in the order of execution (DESIGN section 2), then others as they come. The place of a pass
// in the list is its colour's.
std::vector<std::string> passOrder(const std::vector<const Case*>&);

// How a pass is painted, by its place. From the ninth on colours come again, paler.
struct Paint {
  std::string colour;
  double opacity;
  std::string ink;  // of text on it, on a light ground
};
Paint paintOf(std::size_t place);

// SVG, fastest first; empty if no passes were timed.
std::string passFigure(std::vector<const Case*>);

}  // namespace sundial::chart
