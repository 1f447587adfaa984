#include "page/chart.h"

#include <fmt/format.h>

#include "page/scatter.h"
#include "page/units.h"

namespace sundial::page {

std::string errorChart(const std::vector<ChartPoint>& points) {
  ScatterChart chart{.title = "Wrong pixels against frame time",
                     .xTitle = "frame time, median and quartiles [ms]",
                     .yTitle = "wrong pixels [% of pixels with geometry]"};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ChartPoint& point = points[i];
    if (point.ms > 0)
      chart.points.push_back({.label = point.label,
                              .tip = fmt::format("{}: {} ms, {} wrong", point.label, milliseconds(point.ms),
                                                 percent(point.wrong)),
                              .family = point.family,
                              .mark = i,
                              .x = point.ms,
                              .y = 100 * point.wrong,
                              .lowerX = point.lowerMs,
                              .upperX = point.upperMs});
  }
  return chart.points.empty() ? "<p>No times were measured.</p>" : scatterSvg(chart);
}

}  // namespace sundial::page
