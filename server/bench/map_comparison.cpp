#include "bench/map_comparison.h"

#include <algorithm>

#include "bench/program.h"
#include "shadow/frame_runner.h"

namespace sundial::bench {

namespace {

// `wanted`: whether a pass is run.
template <class Wanted>
std::vector<std::vector<double>> times(const Device& device, const std::vector<Frame*>& frames, int runs,
                                       const Wanted& wanted) {
  std::vector<std::vector<double>> ms(frames.size());
  for (int run = -1; run < runs; ++run)
    for (std::size_t f = 0; f < frames.size(); ++f) {
      std::vector<Pass> passes = frames[f]->passes();
      std::erase_if(passes, [&](const Pass& pass) { return !wanted(pass); });
      const double taken = need(runFrame(device, passes, {})).frameMs;
      if (run >= 0) ms[f].push_back(taken);
    }
  return ms;
}

}  // namespace

std::vector<std::vector<double>> storeTimes(const Device& device, const std::vector<Frame*>& frames,
                                            int runs) {
  return times(device, frames, runs, [](const Pass& pass) { return pass.name == "store"; });
}

std::vector<std::vector<double>> frameTimes(const Device& device, const std::vector<Frame*>& frames,
                                            int runs) {
  return times(device, frames, runs, [](const Pass&) { return true; });
}

double ratio(const std::vector<double>& of, const std::vector<double>& to) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < of.size(); ++i) ratios.push_back(of[i] / to[i]);
  return median(std::move(ratios));
}

Differences differences(const Frame& image, const Frame& linear, const Differ& differ) {
  const std::vector<float> imageDepths = image.downloadDepths(), linearDepths = linear.downloadDepths();
  const shared::Plan imagePlan = image.downloadPlan(), linearPlan = linear.downloadPlan();
  std::uint32_t width = 0;
  for (const shared::ShadowView& v : std::span(imagePlan.views, imagePlan.viewCount))
    width = std::max(width, v.rectOffset.x + v.rectSize.x);
  Differences found;
  for (std::uint32_t view = 0; view < imagePlan.viewCount; ++view) {
    const shared::ShadowView& v = imagePlan.views[view];
    for (std::uint32_t y = 0; y < v.rectSize.y; ++y)
      for (std::uint32_t x = 0; x < v.rectSize.x; ++x) {
        const float a = imageDepths[std::size_t{v.rectOffset.y + y} * width + v.rectOffset.x + x];
        const float b = linearDepths[linearPlan.views[view].linearOffset + y * v.rectSize.x + x];
        found.covered += a > 0;
        found.missing += a > 0 && !(b > 0);
        found.added += !(a > 0) && b > 0;
        const bool byZero = a == 1 && b > 0 && b < 1;
        found.byZero += byZero;
        found.far += !byZero && differ(v, a, b);
      }
  }
  return found;
}

}  // namespace sundial::bench
