#include "chart/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "chart/front.h"
#include "chart/pass_figure.h"
#include "page/scatter.h"
#include "page/units.h"

namespace sundial::chart {
namespace {

using Configuration = std::vector<const Case*>;

// Letters and digits as they are, the rest as one dash.
std::string fileName(const Case& one) {
  std::string name;
  for (const char c : fmt::format("{}-{}-{}-{}", one.scene, one.view, one.light, one.sizeText()))
    if (std::isalnum(static_cast<unsigned char>(c)))
      name += c;
    else if (!name.ends_with('-'))
      name += '-';
  return name;
}

// "sm 2048" where only one parameter differs.
std::string briefLabel(const std::string& label) {
  const auto comma = label.find(','), equals = label.find('=');
  if (comma == std::string::npos || label.find(',', comma + 1) != std::string::npos) return label;
  return label.substr(0, comma) + ' ' + label.substr(equals + 1);
}

// What is drawn against what; less of both is better.
struct Axes {
  std::string xTitle;
  Spread (*x)(const Case&);
  std::string yTitle;
  double (*y)(const Case&);  // a share
};

page::ScatterChart scatter(const Configuration& cases, const std::map<std::string, std::size_t>& marks,
                           const Axes& axes) {
  const Case& first = *cases.front();
  page::ScatterChart chart{.title = fmt::format("{}, {}, {}, {}: {}", first.scene, first.view, first.light,
                                                first.sizeText(), axes.yTitle),
                           .xTitle = axes.xTitle,
                           .yTitle = axes.yTitle};
  std::vector<Cost> costs;
  for (const Case* one : cases) {
    const Spread x = axes.x(*one);
    const double y = axes.y(*one);
    chart.points.push_back({.label = briefLabel(one->label),
                            .tip = fmt::format("{}: {}", one->label, page::percent(y)),
                            .family = one->method,
                            .mark = marks.at(one->method),
                            .x = x.median,
                            .y = 100 * y,
                            .lowerX = x.lower < x.upper ? x.lower : 0,
                            .upperX = x.upper});
    costs.push_back({x.median, y});
  }
  chart.front = paretoFront(costs);
  return chart;
}

Spread memory(const Case& one) {
  const double mebibytes = one.measures.totalBytes / (1 << 20);
  return {mebibytes, mebibytes, mebibytes};
}

constexpr const char* kWrongTitle = "wrong pixels [% of pixels with geometry]";

double wrong(const Case& one) { return one.measures.wrong(); }

Spread wrongPercent(const Case& one) {
  const double percent = 100 * wrong(one);
  return {percent, percent, percent};
}

}  // namespace

std::vector<image::OutputFile> figures(const std::vector<Case>& cases, const std::filesystem::path& folder) {
  std::map<std::string, Configuration> configurations;
  std::map<std::string, std::size_t> marks;
  for (const Case& one : cases) {
    marks.try_emplace(one.method, marks.size());
    if (!one.failed && one.ratio.median > 0) configurations[one.configuration()].push_back(&one);
  }
  std::vector<image::OutputFile> files;
  std::set<std::string> taken;
  for (const auto& [configuration, members] : configurations) {
    std::string name = fileName(*members.front());
    while (!taken.insert(name).second) name += "-2";
    const auto add = [&](std::string_view kind, const std::string& svg) {
      files.push_back({folder / fmt::format("{}-{}.svg", kind, name), page::forPaper(svg)});
    };
    const auto addScatter = [&](std::string_view kind, const Configuration& of, const Axes& axes) {
      add(kind, page::scatterSvg(scatter(of, marks, axes)));
    };
    const std::string ratio =
        fmt::format("frame time / that of {}, median and quartiles", members.front()->baseline);
    addScatter("error-time", members, {ratio, [](const Case& one) { return one.ratio; }, kWrongTitle, wrong});
    addScatter("error-memory", members, {"memory [MiB]", memory, kWrongTitle, wrong});
    if (std::ranges::all_of(members, [](const Case* one) { return one->stability.has_value(); }))
      addScatter("stability", members,
                 {kWrongTitle, wrongPercent, "flip rate [% of points and frames]",
                  [](const Case& one) { return one.stability->flipRate; }});
    if (const std::string svg = passFigure(members); !svg.empty()) add("passes", svg);
  }
  return files;
}

}  // namespace sundial::chart
