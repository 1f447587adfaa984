#include "page/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "page/mark.h"
#include "page/units.h"

namespace sundial::page {
namespace {

// All in pixels.
constexpr double kWidth = 860, kHeight = 460, kLeft = 84, kRight = 24, kTop = 28, kBottom = 62;
constexpr double kZeroBand = 56;  // below the axis of the errors, for exact methods
constexpr double kLabelHeight = 16, kLetter = 7.2;

// A logarithmic scale over whole decades or, where the values are close, over steps of 1, 2 and 5.
class LogScale {
 public:
  LogScale(double least, double most, double from, double to) : from_(from), to_(to) {
    low_ = step(least / 1.15, false);
    high_ = step(most * 1.15, true);
  }

  double at(double value) const {
    return from_ + (std::log(value) - std::log(low_)) / (std::log(high_) - std::log(low_)) * (to_ - from_);
  }

  std::vector<double> ticks() const {
    const bool fine = high_ / low_ <= 1001;
    std::vector<double> values;
    for (double decade = std::pow(10, std::floor(std::log10(low_))); decade <= high_ * 1.001; decade *= 10)
      for (const double digit : {1.0, 2.0, 5.0})
        if ((fine || digit == 1) && decade * digit >= low_ * 0.999 && decade * digit <= high_ * 1.001)
          values.push_back(decade * digit);
    return values;
  }

 private:
  // The next of 1, 2, 5, 10, ... at or beyond the value.
  static double step(double value, bool up) {
    const double decade = std::pow(10, std::floor(std::log10(value)));
    const double digit = value / decade;
    if (up) return decade * (digit <= 1 ? 1 : digit <= 2 ? 2 : digit <= 5 ? 5 : 10);
    return decade * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
  }

  double low_, high_, from_, to_;
};

struct Placed {
  const ChartPoint* point;
  std::size_t index;
  double x, y;
};

// Labels stand above their marks, to the right or at the chart's edge to the left, and move up until free.
std::string labels(std::vector<Placed> marks) {
  struct Box {
    double left, right, top;
  };
  std::vector<Box> taken;
  for (const Placed& mark : marks) taken.push_back({mark.x - 7, mark.x + 7, mark.y - kLabelHeight / 2});
  std::ranges::sort(marks, std::ranges::greater{}, &Placed::y);
  std::string svg;
  for (const Placed& mark : marks) {
    const double width = kLetter * static_cast<double>(mark.point->label.size());
    const bool left = mark.x + width > kWidth - kRight;
    Box box{left ? mark.x - width : mark.x, left ? mark.x : mark.x + width, mark.y - 9 - kLabelHeight};
    const auto collides = [&](const Box& other) {
      return box.left < other.right && other.left < box.right &&
             std::abs(box.top - other.top) < kLabelHeight - 2;
    };
    while (std::ranges::any_of(taken, collides) && box.top > 0) box.top -= 4;
    taken.push_back(box);
    svg += fmt::format(R"svg(<text class="name" x="{:.1f}" y="{:.1f}"{}>{}</text>)svg", mark.x, box.top + 12,
                       left ? R"( text-anchor="end")" : "", escaped(mark.point->label));
  }
  return svg;
}

constexpr const char* kStyle = R"svg(<style>
.chart{--ink:#1d2126;--faint:#d9dde2;--soft:#5b6570;--back:#fff;font:13px system-ui,sans-serif}
@media(prefers-color-scheme:dark){.chart{--ink:#e8eaed;--faint:#363c44;--soft:#9aa4af;--back:#15181c}}
.chart text{fill:var(--ink)}.chart .tick{fill:var(--soft)}.chart .name{font-weight:600;paint-order:stroke;stroke:var(--back);stroke-width:3px}
.chart .grid{stroke:var(--faint);stroke-width:1}.chart .axis{stroke:var(--soft);stroke-width:1.2;fill:none}
.chart .band{fill:var(--faint);opacity:.45}.chart .join{fill:none;stroke:var(--soft);stroke-dasharray:4 4}
.chart .whisker{stroke:var(--ink);stroke-width:1.2}
</style>)svg";

}  // namespace

std::string errorChart(const std::vector<ChartPoint>& points) {
  const auto timed = [](const ChartPoint& point) { return point.ms > 0; };
  if (std::ranges::none_of(points, timed)) return "<p>No times were measured.</p>";

  // The axes' ranges. Exact methods take no part in the errors'.
  double leastMs = HUGE_VAL, mostMs = 0, leastWrong = HUGE_VAL, mostWrong = 0;
  bool zeros = false;
  for (const ChartPoint& point : points) {
    if (!timed(point)) continue;
    leastMs = std::min({leastMs, point.ms, point.lowerMs > 0 ? point.lowerMs : point.ms});
    mostMs = std::max({mostMs, point.ms, point.upperMs});
    zeros |= point.wrong <= 0;
    if (point.wrong <= 0) continue;
    leastWrong = std::min(leastWrong, 100 * point.wrong);
    mostWrong = std::max(mostWrong, 100 * point.wrong);
  }
  if (mostWrong == 0) leastWrong = 0.01, mostWrong = 1;
  const double bottom = kHeight - kBottom - (zeros ? kZeroBand : 0);
  const LogScale x(leastMs, mostMs, kLeft, kWidth - kRight), y(leastWrong, mostWrong, bottom, kTop);
  const double zeroY = kHeight - kBottom - kZeroBand / 3;

  std::string svg = fmt::format(
      R"svg(<svg xmlns="http://www.w3.org/2000/svg" class="chart" viewBox="0 0 {} {}" role="img" aria-label="Wrong pixels against frame time">{})svg",
      kWidth, kHeight, kStyle);
  svg += fmt::format(R"svg(<rect width="{}" height="{}" fill="var(--back)"/>)svg", kWidth, kHeight);
  for (const double tick : x.ticks())
    svg += fmt::format(
        R"svg(<path class="grid" d="M{0:.1f},{1}V{2}"/><text class="tick" x="{0:.1f}" y="{3}" text-anchor="middle">{4}</text>)svg",
        x.at(tick), kTop, kHeight - kBottom, kHeight - kBottom + 18, fmt::format("{:g}", tick));
  for (const double tick : y.ticks())
    svg += fmt::format(
        R"svg(<path class="grid" d="M{0},{1:.1f}H{2}"/><text class="tick" x="{3}" y="{4:.1f}" text-anchor="end">{5}</text>)svg",
        kLeft, y.at(tick), kWidth - kRight, kLeft - 8, y.at(tick) + 4, fmt::format("{:g}", tick));
  if (zeros)
    svg += fmt::format(
        R"svg(<rect class="band" x="{0}" y="{1}" width="{2}" height="{3}"/><text class="tick" x="{4}" y="{5}" text-anchor="end">0</text><path class="axis" d="M{6},{1}l12,-4m-12,8l12,-4"/>)svg",
        kLeft, bottom, kWidth - kRight - kLeft, kZeroBand, kLeft - 8, zeroY + 4, kLeft - 6);
  svg += fmt::format(R"svg(<path class="axis" d="M{0},{1}V{2}H{3}"/>)svg", kLeft, kTop, kHeight - kBottom,
                     kWidth - kRight);
  svg += fmt::format(
      R"svg(<text x="{}" y="{}" text-anchor="middle">frame time, median and quartiles [ms]</text>)svg",
      (kLeft + kWidth - kRight) / 2, kHeight - 16);
  svg += fmt::format(
      R"svg(<text transform="translate(20,{}) rotate(-90)" text-anchor="middle">wrong pixels [% of pixels with geometry]</text>)svg",
      (kTop + kHeight - kBottom) / 2);

  std::vector<Placed> marks;
  std::map<std::string, std::vector<Placed>> families;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!timed(points[i])) continue;
    marks.push_back(
        {&points[i], i, x.at(points[i].ms), points[i].wrong > 0 ? y.at(100 * points[i].wrong) : zeroY});
    families[points[i].family].push_back(marks.back());
  }
  for (auto& [name, members] : families) {
    std::ranges::sort(members, {}, &Placed::x);
    std::string path;
    for (const Placed& mark : members)
      path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "M" : "L", mark.x, mark.y);
    if (members.size() > 1) svg += fmt::format(R"svg(<path class="join" d="{}"/>)svg", path);
  }
  for (const Placed& mark : marks) {
    if (mark.point->lowerMs > 0)
      svg += fmt::format(R"svg(<path class="whisker" d="M{:.1f},{:.1f}H{:.1f}"/>)svg",
                         x.at(mark.point->lowerMs), mark.y, x.at(mark.point->upperMs));
    svg += fmt::format("<g><title>{}: {} ms, {} wrong</title>{}</g>", escaped(mark.point->label),
                       milliseconds(mark.point->ms), percent(mark.point->wrong),
                       markAt(mark.index, mark.x, mark.y));
  }
  return svg + labels(marks) + "</svg>\n";
}

}  // namespace sundial::page
