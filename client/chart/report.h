// The page of a sweep: charts and tables of all its cases in one file that needs no network.
#pragma once

#include <string>
#include <vector>

#include "chart/results.h"

namespace sundial::chart {

// At least one case. Adds a remark for pictures that can't be read. `credits`: plain text, a line each.
std::string reportPage(Results&, const std::vector<std::string>& credits);

}  // namespace sundial::chart
