#include "page/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "page/mark.h"
#include "page/units.h"

namespace sundial::page {
namespace {

// All in pixels.
constexpr double kWidth = 860, kHeight = 460, kLeft = 84, kRight = 24, kTop = 28, kBottom = 62;
constexpr double kZeroBand = 56;  // beside a logarithmic axis, for zeros
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
  const ScatterPoint* point;
  double x, y;
};

struct Box {
  double left, right, top;
  bool end;  // its text ends at its right
};

// Beside a mark: to the right, the left, and the corners.
std::vector<Box> placesBeside(const Placed& mark) {
  const double width = kLetter * static_cast<double>(mark.point->label.size()), middle = kLabelHeight / 2;
  std::vector<Box> places;
  for (const double top : {-middle, -9 - kLabelHeight, 9.0})
    for (const double gap : top == -middle ? std::array{11.0, -11.0} : std::array{0.0, -0.1})
      places.push_back(gap >= 0 ? Box{mark.x + gap, mark.x + gap + width, mark.y + top, false}
                                : Box{mark.x + gap - width, mark.x + gap, mark.y + top, true});
  return places;
}

// Each beside its mark where that is free, or else above it as near as may be.
std::string labels(std::vector<Placed> marks) {
  std::vector<Box> taken;
  for (const Placed& mark : marks)
    taken.push_back({mark.x - 7, mark.x + 7, mark.y - kLabelHeight / 2, false});
  std::ranges::sort(marks, std::ranges::greater{}, &Placed::y);
  std::string svg;
  for (const Placed& mark : marks) {
    const auto free = [&](const Box& box) {
      return box.left > kLeft && box.right < kWidth && box.top > 0 && box.top < kHeight - kBottom - 10 &&
             std::ranges::none_of(taken, [&](const Box& other) {
               return box.left < other.right && other.left < box.right &&
                      std::abs(box.top - other.top) < kLabelHeight - 2;
             });
    };
    const std::vector<Box> places = placesBeside(mark);
    const auto found = std::ranges::find_if(places, free);
    Box box = found != places.end() ? *found : places[2];
    if (box.right > kWidth) box = places[3];
    while (!free(box) && box.top > 0) box.top -= 4;
    taken.push_back(box);
    svg += fmt::format(R"svg(<text class="name" x="{:.1f}" y="{:.1f}"{}>{}</text>)svg",
                       box.end ? box.right : box.left, box.top + 12, box.end ? R"( text-anchor="end")" : "",
                       escaped(mark.point->label));
  }
  return svg;
}

constexpr const char* kColours = R"svg(<style>
.chart{--ink:#1d2126;--faint:#d9dde2;--soft:#5b6570;--back:#fff}
@media(prefers-color-scheme:dark){.chart{--ink:#e8eaed;--faint:#363c44;--soft:#9aa4af;--back:#15181c}}
</style>)svg";
constexpr const char* kStyle = R"svg(<style>
.chart{font:13px system-ui,sans-serif}
.chart text{fill:var(--ink)}.chart .tick{fill:var(--soft)}.chart .name{font-weight:600;paint-order:stroke;stroke:var(--back);stroke-width:3px}
.chart .grid{stroke:var(--faint);stroke-width:1}.chart .axis{stroke:var(--soft);stroke-width:1.2;fill:none}
.chart .band{fill:var(--faint);opacity:.45}.chart .join{fill:none;stroke:var(--soft);stroke-dasharray:4 4}
.chart .whisker{stroke:var(--ink);stroke-width:1.2}.chart .front{fill:none;stroke:#0072b2;stroke-width:2;opacity:.75}
</style>)svg";

// An axis: the scale of what is above zero, and where it and the band of zeros lie.
struct Axis {
  LogScale scale;
  bool zeros;
  double zero;  // the middle of the band

  // The band lies at `from`'s end.
  static Axis of(const std::vector<double>& values, double from, double to) {
    double least = HUGE_VAL, most = 0;
    bool zeros = false;
    for (const double value : values) {
      zeros |= value <= 0;
      if (value > 0) least = std::min(least, value), most = std::max(most, value);
    }
    if (most == 0) least = 0.01, most = 1;
    const double towards = to > from ? 1 : -1;
    return {LogScale(least, most, zeros ? from + towards * kZeroBand : from, to), zeros,
            from + towards * kZeroBand / 3};
  }

  double at(double value) const { return value > 0 ? scale.at(value) : zero; }
};

// What a budget of x buys at best, to the right edge.
std::string frontPath(const ScatterChart& chart, const Axis& x, const Axis& y) {
  std::string path;
  for (const std::size_t index : chart.front) {
    const double px = x.at(chart.points[index].x), py = y.at(chart.points[index].y);
    path += path.empty() ? fmt::format("M{:.1f},{:.1f}", px, py) : fmt::format("H{:.1f}V{:.1f}", px, py);
  }
  if (path.empty()) return "";
  return fmt::format(R"svg(<path class="front" d="{}H{:.1f}"/>)svg", path, kWidth - kRight);
}

// Dashes from mark to mark of a family, in order of x.
std::string joins(const std::vector<Placed>& marks) {
  std::map<std::string, std::vector<Placed>> families;
  for (const Placed& mark : marks) families[mark.point->family].push_back(mark);
  std::string svg;
  for (auto& [name, members] : families) {
    if (members.size() < 2) continue;
    std::ranges::sort(members, {}, &Placed::x);
    std::string path;
    for (const Placed& mark : members)
      path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "M" : "L", mark.x, mark.y);
    svg += fmt::format(R"svg(<path class="join" d="{}"/>)svg", path);
  }
  return svg;
}

// Grid, numbers, bands of zeros and titles.
std::string axes(const ScatterChart& chart, const Axis& x, const Axis& y) {
  constexpr double kBottomLine = kHeight - kBottom, kRightLine = kWidth - kRight;
  std::string svg;
  for (const double tick : x.scale.ticks())
    svg += fmt::format(
        R"svg(<path class="grid" d="M{0:.1f},{1}V{2}"/><text class="tick" x="{0:.1f}" y="{3}" text-anchor="middle">{4}</text>)svg",
        x.at(tick), kTop, kBottomLine, kBottomLine + 18, fmt::format("{:g}", tick));
  for (const double tick : y.scale.ticks())
    svg += fmt::format(
        R"svg(<path class="grid" d="M{0},{1:.1f}H{2}"/><text class="tick" x="{3}" y="{4:.1f}" text-anchor="end">{5}</text>)svg",
        kLeft, y.at(tick), kRightLine, kLeft - 8, y.at(tick) + 4, fmt::format("{:g}", tick));
  if (y.zeros)
    svg += fmt::format(
        R"svg(<rect class="band" x="{0}" y="{1}" width="{2}" height="{3}"/><text class="tick" x="{4}" y="{5}" text-anchor="end">0</text><path class="axis" d="M{6},{1}l12,-4m-12,8l12,-4"/>)svg",
        kLeft, kBottomLine - kZeroBand, kRightLine - kLeft, kZeroBand, kLeft - 8, y.zero + 4, kLeft - 6);
  if (x.zeros)
    svg += fmt::format(
        R"svg(<rect class="band" x="{0}" y="{1}" width="{2}" height="{3}"/><text class="tick" x="{4:.1f}" y="{5}" text-anchor="middle">0</text><path class="axis" d="M{6},{7}l4,-12m-8,12l4,-12"/>)svg",
        kLeft, kTop, kZeroBand, kBottomLine - kTop, x.zero, kBottomLine + 18, kLeft + kZeroBand,
        kBottomLine + 6);
  svg +=
      fmt::format(R"svg(<path class="axis" d="M{0},{1}V{2}H{3}"/>)svg", kLeft, kTop, kBottomLine, kRightLine);
  svg += fmt::format(R"svg(<text x="{}" y="{}" text-anchor="middle">{}</text>)svg", (kLeft + kRightLine) / 2,
                     kHeight - 16, escaped(chart.xTitle));
  return svg +
         fmt::format(R"svg(<text transform="translate(20,{}) rotate(-90)" text-anchor="middle">{}</text>)svg",
                     (kTop + kBottomLine) / 2, escaped(chart.yTitle));
}

}  // namespace

std::string scatterSvg(const ScatterChart& chart) {
  std::vector<double> xs, ys;
  for (const ScatterPoint& point : chart.points) {
    xs.push_back(point.x);
    if (point.lowerX > 0) xs.insert(xs.end(), {point.lowerX, point.upperX});
    ys.push_back(point.y);
  }
  const Axis x = Axis::of(xs, kLeft, kWidth - kRight), y = Axis::of(ys, kHeight - kBottom, kTop);
  std::vector<Placed> marks;
  for (const ScatterPoint& point : chart.points) marks.push_back({&point, x.at(point.x), y.at(point.y)});

  std::string svg = fmt::format(
      R"svg(<svg xmlns="http://www.w3.org/2000/svg" class="chart" viewBox="0 0 {0} {1}" role="img" aria-label="{2}">{3}{4}<rect width="{0}" height="{1}" fill="var(--back)"/>)svg",
      kWidth, kHeight, escaped(chart.title), kColours, kStyle);
  svg += axes(chart, x, y) + joins(marks) + frontPath(chart, x, y);
  for (const Placed& mark : marks) {
    if (mark.point->lowerX > 0)
      svg += fmt::format(R"svg(<path class="whisker" d="M{:.1f},{:.1f}H{:.1f}"/>)svg",
                         x.at(mark.point->lowerX), mark.y, x.at(mark.point->upperX));
    svg += fmt::format("<g><title>{}</title>{}</g>", escaped(mark.point->tip),
                       markAt(mark.point->mark, mark.x, mark.y));
  }
  return svg + labels(marks) + "</svg>\n";
}

std::string forPaper(std::string svg) {
  if (const std::size_t at = svg.find(kColours); at != std::string::npos)
    svg.erase(at, std::string_view(kColours).size());
  static constexpr std::pair<std::string_view, std::string_view> kLight[] = {
      {"var(--ink)", "#1d2126"},
      {"var(--ink,#1d2126)", "#1d2126"},
      {"var(--faint)", "#d9dde2"},
      {"var(--soft)", "#5b6570"},
      {"var(--back)", "#fff"},
      {"var(--back,#fff)", "#fff"},
      {"system-ui,sans-serif", "sans-serif"}};
  for (const auto& [name, colour] : kLight)
    for (std::size_t at = 0; (at = svg.find(name, at)) != std::string::npos; at += colour.size())
      svg.replace(at, name.size(), colour);
  return svg;
}

}  // namespace sundial::page
