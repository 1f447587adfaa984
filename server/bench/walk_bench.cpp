// sundial-bench-walk [FRAMES [PERCENTILE]]: estimated resolution along the walk through `atrium`, at most
// 4096 x 4096 texels, with the paper's minimum and with a percentile, against a fixed map of 4096 x 4096
// [Ferko 2013, figures 3 and 4]. Prints a line a frame and the medians; writes walk-size.svg and
// walk-time.svg into the working folder.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <fstream>

#include "bench/need.h"
#include "renderer.h"
#include "scene/choose.h"
#include "scene/load.h"
#include "stability/path.h"

namespace sundial::bench {

namespace {

constexpr std::string_view kFixed = "sm,texels=4096";

// What a method did in one frame of the walk.
struct Step {
  glm::uvec2 texels{0};
  double ms = 0, ratio = 0, wrong = 0;  // ratio: of the frame, to the fixed map's
};
using Steps = std::vector<Step>;  // a method each

class Collector final : public JobSink {
 public:
  void onPlan(std::size_t, const std::vector<PlanView>&) override {}
  void onImage(std::size_t, Image) override {}
  void onResult(std::size_t, MethodResult result) override {
    steps.push_back({result.plan.front().gpu.rectSize, result.frameMs.median,
                     result.ratio ? result.ratio->median : 1,
                     result.measures ? 1 - result.measures->pixelMatch : 0});
  }
  Steps steps;
};

template <class Value>
double median(const std::vector<Steps>& walk, std::size_t method, Value value) {
  std::vector<double> values;
  for (const Steps& frame : walk) values.push_back(value(frame[method]));
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
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
  RenderJob job;
  job.scene = std::make_shared<const Scene>(need(makeBuiltin("atrium")));
  job.light = need(chooseLight(*job.scene, "spot"));
  job.size = {1024, 1024};
  job.baseline = need(parseMethod(kFixed));
  job.methods = {job.baseline.value(), need(parseMethod("ferko")),
                 need(parseMethod(fmt::format("ferko,percentile={}", percentile)))};
  job.repetitions = 3;
  job.measures = true;
  std::vector<Steps> all;
  const NamedPath path = need(choosePath(*job.scene, "walk"));
  fmt::print(
      "frame  {} ms, wrong %   minimum: texels, ms, ratio, wrong %   {} %: texels, ms, ratio, wrong %\n",
      kFixed, percentile);
  for (const View& view : need(viewsAlong(path.keys, frames))) {
    Collector collector;
    job.view = view;
    need(renderer->run(job, {}, collector));
    const Steps& s = all.emplace_back(std::move(collector.steps));
    fmt::print("{:5}  {:6.1f} {:.4f}", all.size() - 1, s[0].ms, 100 * s[0].wrong);
    for (const Step& step : {s[1], s[2]})
      fmt::print("   {:4}x{:4} {:6.1f} {:.2f} {:.4f}", step.texels.x, step.texels.y, step.ms, step.ratio,
                 100 * step.wrong);
    fmt::print("\n");
    std::fflush(stdout);
  }
  for (std::size_t method = 0; method < 3; ++method)
    fmt::print("{:22} median frame {:.2f} of the fixed map's, median of wrong pixels {:.4f} %\n",
               job.methods[method].label(), median(all, method, [](const Step& s) { return s.ratio; }),
               median(all, method, [](const Step& s) { return 100 * s.wrong; }));
  writeCharts(all, percentile);
}

}  // namespace

}  // namespace sundial::bench

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::atoi(argv[1]) : 24;
  if (frames < 2 || argc > 3) {
    fmt::print(stderr, "sundial-bench-walk: give [FRAMES [PERCENTILE]], at least 2 frames\n");
    return 2;
  }
  try {
    sundial::bench::walk(static_cast<unsigned>(frames), argc > 2 ? argv[2] : "1");
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "sundial-bench-walk: {}\n", error.what());
    return 1;
  }
}
