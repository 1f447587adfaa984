// The Pareto front: what no other choice beats in both time and error.
#pragma once

#include <cstddef>
#include <vector>

namespace sundial::chart {

struct Cost {
  double time = 0, error = 0;
};

// Indices of the front in order of time, each of less error than the one before. Of equal ones the first.
std::vector<std::size_t> paretoFront(const std::vector<Cost>&);

}  // namespace sundial::chart
