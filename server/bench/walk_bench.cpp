// sundial-bench-walk [FRAMES [PERCENTILE]]: estimated resolution along the walk through `atrium`, at most
// 4096 x 4096 texels, with the paper's minimum and with a percentile, against a fixed map of 4096 x 4096
// [Ferko 2013, figures 3 and 4]. Prints a line a frame and the medians; writes walk-size.svg and
// walk-time.svg into the working folder.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "bench/program.h"
#include "bench/results.h"
#include "scene/choose.h"
#include "stability/path.h"

namespace sundial::bench {

namespace {

constexpr std::string_view kFixed = "sm,texels=4096";
constexpr unsigned kRuns = 3;

// What a method did in one frame of the walk.
struct Step {
  glm::uvec2 texels{0};
  double ms = 0, ratio = 0, wrong = 0;  // ratio: of the frame, to the fixed map's; wrong: %
};
using Steps = std::vector<Step>;  // a method each

Steps stepsOf(const std::vector<MethodResult>& results) {
  Steps steps;
  for (const MethodResult& result : results)
    steps.push_back({result.plan.front().gpu.rectSize, result.frameMs.median, result.ratio->median,
                     wrongPercent(result)});
  return steps;
}

template <class Value>
double median(const std::vector<Steps>& walk, std::size_t method, Value value) {
  std::vector<double> values;
  for (const Steps& frame : walk) values.push_back(value(frame[method]));
  return bench::median(std::move(values));
}

// One line a series, over the frames of the walk.
struct Series {
  std::string name, colour;
  std::vector<double> values;
};
void writeChart(const std::string& file, std::string_view title, const std::vector<Series>& series) {
  constexpr double kWidth = 720, kHeight = 300, kLeft = 60, kTop = 40;
  double most = 0;
  for (const Series& s : series) most = std::max(most, std::ranges::max(s.values));
  std::ofstream out(file);
  out << fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}" font-family="sans-serif" font-size="12">)"
      R"(<rect width="100%" height="100%" fill="white"/><text x="{}" y="18">{}</text>)",
      kWidth + kLeft + 20, kHeight + kTop + 30, kLeft, title);
  for (int i = 0; i <= 4; ++i)
    out << fmt::format(
        R"(<line x1="{0}" x2="{1}" y1="{2}" y2="{2}" stroke="#ddd"/><text x="8" y="{2}">{3:.0f}</text>)",
        kLeft, kLeft + kWidth, kTop + kHeight * (1 - i / 4.0), most * i / 4);
  double legend = kLeft;
  for (const Series& s : series) {
    std::string points;
    for (std::size_t i = 0; i < s.values.size(); ++i)
      points += fmt::format("{:.1f},{:.1f} ",
                            kLeft + kWidth * static_cast<double>(i) /
                                        std::max<double>(1, static_cast<double>(s.values.size() - 1)),
                            kTop + kHeight * (1 - s.values[i] / most));
    out << fmt::format(
        R"(<polyline fill="none" stroke="{0}" stroke-width="2" points="{1}"/><text x="{2}" y="34" fill="{0}">{3}</text>)",
        s.colour, points, legend, s.name);
    legend += 180;
  }
  out << fmt::format(R"(<text x="{}" y="{}">frame of the walk</text></svg>)", kLeft, kTop + kHeight + 20);
}

std::vector<double> column(const std::vector<Steps>& walk, std::size_t method, double (*value)(const Step&)) {
  std::vector<double> out;
  for (const Steps& frame : walk) out.push_back(value(frame[method]));
  return out;
}

void writeCharts(const std::vector<Steps>& walk, const std::string& percentile) {
  const auto series = [&](std::size_t method, std::string name, std::string colour,
                          double (*value)(const Step&)) {
    return Series{std::move(name), std::move(colour), column(walk, method, value)};
  };
  constexpr auto width = [](const Step& s) { return double(s.texels.x); };
  constexpr auto height = [](const Step& s) { return double(s.texels.y); };
  constexpr auto ms = [](const Step& s) { return s.ms; };
  writeChart("walk-size.svg", "Texels of the chosen map",
             {series(1, "minimum, width", "#b00", width), series(1, "minimum, height", "#e88", height),
              series(2, percentile + " %, width", "#05a", width),
              series(2, percentile + " %, height", "#7be", height)});
  writeChart("walk-time.svg", "Milliseconds per frame",
             {series(0, "fixed 4096", "#888", ms), series(1, "minimum", "#b00", ms),
              series(2, percentile + " %", "#05a", ms)});
}

void walk(unsigned frames, const std::string& percentile) {
  const auto renderer = need(Renderer::create("", false));
  const Sight sight = sightOf({"builtin:atrium", "", "spot"});
  const std::string ferko = "ferko,percentile=" + percentile;
  RenderJob job = jobAt(sight, {1024, 1024}, {std::string(kFixed), "ferko", ferko}, kRuns);
  std::vector<Steps> all;
  const NamedPath path = need(choosePath(*sight.scene, "walk"));
  fmt::print(
      "frame  {} ms, wrong %   minimum: texels, ms, ratio, wrong %   {} %: texels, ms, ratio, wrong %\n",
      kFixed, percentile);
  for (const View& view : need(viewsAlong(path.keys, frames))) {
    job.view = view;
    const Steps& s = all.emplace_back(stepsOf(resultsOf(*renderer, job)));
    fmt::print("{:5}  {:6.1f} {:.4f}", all.size() - 1, s[0].ms, s[0].wrong);
    for (const Step& step : {s[1], s[2]})
      fmt::print("   {:4}x{:4} {:6.1f} {:.2f} {:.4f}", step.texels.x, step.texels.y, step.ms, step.ratio,
                 step.wrong);
    fmt::print("\n");
    std::fflush(stdout);
  }
  for (std::size_t method = 0; method < 3; ++method)
    fmt::print("{:22} median frame {:.2f} of the fixed map's, median of wrong pixels {:.4f} %\n",
               job.methods[method].label(), median(all, method, [](const Step& s) { return s.ratio; }),
               median(all, method, [](const Step& s) { return s.wrong; }));
  writeCharts(all, percentile);
}

int run(const Arguments& arguments) {
  const auto frames = arguments.empty() ? std::optional(24u) : countOf(arguments[0]);
  if (frames.value_or(0) < 2 || arguments.size() > 2)
    throw WrongArguments("give [FRAMES [PERCENTILE]], at least 2 frames");
  walk(*frames, arguments.size() > 1 ? arguments[1] : "1");
  return 0;
}

}  // namespace

}  // namespace sundial::bench

int main(int argc, char** argv) {
  return sundial::bench::runProgram("sundial-bench-walk", argc, argv, sundial::bench::run);
}
