#include "chart/pass_figure.h"

#include <fmt/format.h>

#include <algorithm>

#include "image/picture.h"
#include "page/mark.h"
#include "page/units.h"

namespace sundial::chart {
namespace {

// All in pixels.
constexpr double kWidth = 860, kNames = 190, kSums = 90, kRow = 30, kBar = 22, kTop = 40, kBottom = 34;

double passSum(const Case& one) {
  double sum = 0;
  for (const Pass& pass : one.passes) sum += pass.ms.median;
  return sum;
}

std::string text(double x, double y, const char* anchor, std::string_view colour, std::string_view words) {
  return fmt::format(R"svg(<text x="{:.1f}" y="{:.1f}" text-anchor="{}" fill="{}">{}</text>)svg", x, y,
                     anchor, colour, page::escaped(words));
}

std::string legend(const std::vector<std::string>& names) {
  std::string svg;
  double x = kNames;
  for (std::size_t i = 0; i < names.size(); ++i) {
    svg +=
        fmt::format(R"svg(<rect x="{:.1f}" y="12" width="12" height="12" fill="{}" fill-opacity="{}"/>)svg",
                    x, paintOf(i).colour, paintOf(i).opacity);
    svg += text(x + 17, 23, "start", "#1d2126", names[i]);
    x += 34 + 7.2 * static_cast<double>(names[i].size());
  }
  return svg;
}

}  // namespace

Paint paintOf(std::size_t place) {
  if (place < image::kOkabeItoCount) return {page::colourOf(place), 1, page::inkOn(place)};
  return {page::colourOf(place), 0.4, "var(--ink,#1d2126)"};
}

std::vector<std::string> passOrder(const std::vector<const Case*>& cases) {
  std::vector<std::string> names{"gbuffer", "analyze", "plan", "cull", "store", "resolve", "shade"};
  for (const Case* one : cases)
    for (const Pass& pass : one->passes)
      if (std::ranges::find(names, pass.name) == names.end()) names.push_back(pass.name);
  std::erase_if(names, [&](const std::string& name) {
    return std::ranges::none_of(cases, [&](const Case* one) {
      return std::ranges::find(one->passes, name, &Pass::name) != one->passes.end();
    });
  });
  return names;
}

std::string passFigure(std::vector<const Case*> cases) {
  std::erase_if(cases, [](const Case* one) { return passSum(*one) <= 0; });
  if (cases.empty()) return "";
  std::ranges::stable_sort(cases, {}, [](const Case* one) { return passSum(*one); });
  const std::vector<std::string> names = passOrder(cases);
  const double scale = (kWidth - kNames - kSums) / passSum(*cases.back());
  const double height = kTop + kRow * static_cast<double>(cases.size()) + kBottom;

  std::string svg = fmt::format(
      R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" font-family="sans-serif" font-size="12"><rect width="{0}" height="{1}" fill="#fff"/>)svg",
      kWidth, height);
  svg += legend(names);
  double y = kTop;
  for (const Case* one : cases) {
    svg += text(kNames - 8, y + 15, "end", "#1d2126", one->label);
    double x = kNames;
    for (const Pass& pass : one->passes) {
      const auto place = static_cast<std::size_t>(std::ranges::find(names, pass.name) - names.begin());
      const Paint paint = paintOf(place);
      const double width = pass.ms.median * scale;
      svg += fmt::format(
          R"svg(<rect x="{:.2f}" y="{:.1f}" width="{:.2f}" height="{}" fill="{}" fill-opacity="{}" stroke="#fff"><title>{}: {} ms</title></rect>)svg",
          x, y, width, kBar, paint.colour, paint.opacity, page::escaped(pass.name),
          page::milliseconds(pass.ms.median));
      if (width > 7.2 * static_cast<double>(pass.name.size()))
        svg += text(x + width / 2, y + 15, "middle", paint.ink, pass.name);
      x += width;
    }
    svg += text(x + 8, y + 15, "start", "#5b6570", page::milliseconds(passSum(*one)) + " ms");
    y += kRow;
  }
  return svg + text(kNames, y + 18, "start", "#1d2126", "median time of the passes on the device [ms]") +
         "</svg>\n";
}

}  // namespace sundial::chart
