// Time of every pass, stacked: a bar a method.
#pragma once

#include <string>
#include <vector>

#include "chart/results.h"

namespace sundial::chart {

// Of all cases: in the order of execution (DESIGN section 2), then others as they come. The place of a pass
// in the list is its colour's.
std::vector<std::string> passOrder(const std::vector<const Case*>&);

// SVG, fastest first; empty if no passes were timed.
std::string passFigure(std::vector<const Case*>);

}  // namespace sundial::chart
