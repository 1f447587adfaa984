// Results as a table for spreadsheets: RFC 4180, one row a case.
#pragma once

#include <string>
#include <vector>

#include "chart/results.h"

namespace sundial::chart {

// Columns: what was asked, the parameters ("parameter.texels"), the numbers, milliseconds of every pass
// ("pass.store.ms"), whether the case lies on the front of wrong pixels against time among the methods of its
// scene, view, light and size; the error of a failed case, whose numbers are empty.
std::string csvOf(const std::vector<Case>&);

}  // namespace sundial::chart
