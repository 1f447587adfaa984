// sundial-bench-walk [FRAMES [RUNS [METHOD...]]]: estimated resolution along the walk through `atrium`, at
// most 4096 x 4096 texels, against a fixed map of 4096 x 4096 [Ferko 2013, figures 3 and 4]. RUNS: timed
// frames of each method, 0 for no times; METHOD: by default the paper's minimum, percentiles, and texels no
// finer than they need be. Prints a line a frame and the medians; writes walk-size.svg and walk-time.svg into
// the working folder.
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
const std::vector<std::string> kMethods = {"ferko", "ferko,percentile=0.5", "ferko,percentile=1",
                                           "ferko,finest=0.95"};

// What a method did in one frame of the walk.
struct Step {
  glm::uvec2 texels{0};
  double ms = 0, ratio = 0, wrong = 0;  // ratio: of the frame, to the fixed map's; wrong: %
};
using Steps = std::vector<Step>;  // a method each

Steps stepsOf(const std::vector<MethodResult>& results) {
  Steps steps;
  for (const MethodResult& result : results)
    steps.push_back({result.plan.front().gpu.rectSize, result.frameMs.median,
                     result.ratio ? result.ratio->median : 0, wrongPercent(result)});
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
  std::string name;  // empty: a second line of the series before
  std::string colour;
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
        R"(<polyline fill="none" stroke="{0}" stroke-width="2" {1} points="{2}"/><text x="{3}" y="34" fill="{0}">{4}</text>)",
        s.colour, s.name.empty() ? R"(stroke-dasharray="6 4")" : "", points, legend, s.name);
    if (!s.name.empty()) legend += 180;
  }
  out << fmt::format(R"(<text x="{}" y="{}">frame of the walk</text></svg>)", kLeft, kTop + kHeight + 20);
}

std::vector<double> column(const std::vector<Steps>& walk, std::size_t method, double (*value)(const Step&)) {
  std::vector<double> out;
  for (const Steps& frame : walk) out.push_back(value(frame[method]));
  return out;
}

void writeCharts(const std::vector<Steps>& walk, const std::vector<Method>& methods) {
  constexpr std::string_view kColours[] = {"#888", "#b00", "#05a", "#084", "#a60", "#60a"};
  std::vector<Series> sizes, times;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const std::string name = methods[m].label(), colour(kColours[m % std::size(kColours)]);
    times.push_back({name, colour, column(walk, m, [](const Step& s) { return s.ms; })});
    if (m == 0) continue;
    sizes.push_back({name, colour, column(walk, m, [](const Step& s) { return double(s.texels.x); })});
    sizes.push_back({"", colour, column(walk, m, [](const Step& s) { return double(s.texels.y); })});
  }
  writeChart("walk-size.svg", "Texels of the chosen map: width, and dashed height", sizes);
  writeChart("walk-time.svg", "Milliseconds per frame", times);
}

void walk(unsigned frames, unsigned runs, std::vector<std::string> methods) {
  const auto renderer = need(Renderer::create("", false));
  const Sight sight = sightOf({"builtin:atrium", "", "spot"});
  methods.insert(methods.begin(), std::string(kFixed));
  RenderJob job = jobAt(sight, {1024, 1024}, methods, runs);
  std::vector<Steps> all;
  const NamedPath path = need(choosePath(*sight.scene, "walk"));
  fmt::print("Of each frame and method: texels, ms, ratio to {}, wrong pixels in %\n", kFixed);
  for (const View& view : need(viewsAlong(path.keys, frames))) {
    job.view = view;
    const Steps& steps = all.emplace_back(stepsOf(resultsOf(*renderer, job)));
    fmt::print("{:5}", all.size() - 1);
    for (const Step& step : steps)
      fmt::print("   {:4}x{:4} {:6.1f} {:.2f} {:.4f}", step.texels.x, step.texels.y, step.ms, step.ratio,
                 step.wrong);
    fmt::print("\n");
    std::fflush(stdout);
  }
  for (std::size_t m = 0; m < methods.size(); ++m)
    fmt::print("{:26} median of frames: {:.2f} of the fixed map's time, {:.4f} % wrong\n", methods[m],
               median(all, m, [](const Step& s) { return s.ratio; }),
               median(all, m, [](const Step& s) { return s.wrong; }));
  if (runs > 0) writeCharts(all, job.methods);
}

int run(const Arguments& arguments) {
  const auto frames = arguments.empty() ? std::optional(24u) : countOf(arguments[0]);
  const auto runs = arguments.size() < 2 ? std::optional(3u) : countOf(arguments[1]);
  if (frames.value_or(0) < 2 || !runs)
    throw WrongArguments("give [FRAMES [RUNS [METHOD...]]], at least 2 frames; RUNS 0 for no times");
  walk(*frames, *runs, arguments.size() < 3 ? kMethods : Arguments(arguments.begin() + 2, arguments.end()));
  return 0;
}

}  // namespace

}  // namespace sundial::bench

int main(int argc, char** argv) {
  return sundial::bench::runProgram("sundial-bench-walk", argc, argv, sundial::bench::run);
}
