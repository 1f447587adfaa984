#include "chart/front.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sundial::chart {

std::vector<std::size_t> paretoFront(const std::vector<Cost>& costs) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return costs[a].time != costs[b].time ? costs[a].time < costs[b].time : costs[a].error < costs[b].error;
  });
  std::vector<std::size_t> front;
  double least = HUGE_VAL;
  for (const std::size_t index : order) {
    if (!(costs[index].error < least)) continue;
    least = costs[index].error;
    front.push_back(index);
  }
  return front;
}

}  // namespace sundial::chart
