// sundial-bench-raster: the compute rasteriser against the pipeline, on built-in scenes. Times are those of
// the clock around the store pass, interleaved run by run; ratios are medians of pairs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "scene/choose.h"
#include "scene/load.h"
#include "shadow/camera.h"
#include "shadow/frame_runner.h"

using namespace sundial;

namespace {
template <class T>
T need(Result<T> r) {
  if (!r) throw std::runtime_error(r.error().message);
  return std::move(*r);
}
double median(std::vector<double> v) {
  std::ranges::sort(v);
  return v[v.size() / 2];
}
}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argv[1];
  const std::string sceneName = argv[2], viewName = argv[3], lightName = argv[4];
  const int repeat = std::atoi(argv[5]);
  auto device = need(Device::create("", false));
  FramePipelines pipelines(*device);
  const ViewTarget target(*device, {512, 512});
  auto scene = std::make_shared<const Scene>(need(makeBuiltin(sceneName)));
  SceneBuffers buffers(*device, scene);
  const View view = need(chooseView(*scene, viewName));
  Light light = need(chooseLight(*scene, lightName));
  light.direction = glm::normalize(light.direction);
  const glm::dvec3 origin = frameOrigin(*scene, view);
  buffers.moveTo(*device, origin);
  const FrameView frameView{.device = *device,
                            .pipelines = pipelines,
                            .scene = buffers,
                            .target = target,
                            .reference = nullptr,
                            .light = light,
                            .origin = origin,
                            .constants = frameConstants(*scene, view, light, target.size(), origin)};
  std::vector<std::unique_ptr<Frame>> frames;
  std::vector<std::string> names;
  for (int i = 6; i < argc; ++i) {
    names.push_back(argv[i]);
    frames.push_back(std::make_unique<Frame>(frameView, need(parseMethod(argv[i]))));
    need(runFrame(*device, frames.back()->passes(), {}));
  }
  std::vector<std::vector<double>> ms(frames.size());
  for (int r = 0; r < repeat; ++r)
    for (std::size_t f = 0; f < frames.size(); ++f) {
      auto passes = frames[f]->passes();
      std::erase_if(passes, [](const Pass& p) { return p.name != "store"; });
      ms[f].push_back(need(runFrame(*device, passes, {})).frameMs);
    }
  for (std::size_t f = 0; f < frames.size(); ++f) {
    std::vector<double> ratios;
    for (int r = 0; r < repeat; ++r) ratios.push_back(ms[f][r] / ms[0][r]);
    if (repeat) fmt::print("{:40} {:8.2f} ms  ratio {:.3f}\n", names[f], median(ms[f]), median(ratios));
  }
  if (mode == "check") {
    const auto a = frames[0]->downloadDepths();
    const auto plan = frames[0]->downloadPlan();
    for (std::size_t f = 1; f < frames.size(); ++f) {
      const auto b = frames[f]->downloadDepths();
      const auto planB = frames[f]->downloadPlan();
      std::size_t covered = 0, missing = 0, added = 0, depth4 = 0, depth6 = 0;
      double worst = 0;
      // a is an image
      std::uint32_t width = 0;
      for (std::uint32_t v = 0; v < plan.viewCount; ++v)
        width = std::max(width, plan.views[v].rectOffset.x + plan.views[v].rectSize.x);
      for (std::uint32_t v = 0; v < plan.viewCount; ++v) {
        const auto& s = plan.views[v];
        for (std::uint32_t y = 0; y < s.rectSize.y; ++y)
          for (std::uint32_t x = 0; x < s.rectSize.x; ++x) {
            const float da = a[(s.rectOffset.y + y) * width + s.rectOffset.x + x];
            const float db = b[planB.views[v].linearOffset + y * s.rectSize.x + x];
            covered += da > 0;
            missing += da > 0 && !(db > 0);
            if (da > 0 && !(db > 0) && missing < 4)
              fmt::print("  missing view {} {} {} depth {}\n", v, x, y, da);
            if (!(da > 0) && db > 0 && added < 4) fmt::print("  added view {} {} {} depth {}\n", v, x, y, db);
            added += !(da > 0) && db > 0;
            const double d = std::abs(da - db);
            if (d > 1e-4 && depth4 < 4) fmt::print("  depth view {} {} {}: {} {}\n", v, x, y, da, db);
            depth4 += d > 1e-4;
            depth6 += d > 1e-6;
            worst = std::max(worst, d);
          }
      }
      fmt::print("{:40} covered {} missing {} added {} depth>1e-4 {} >1e-6 {} worst {:.2g}\n", names[f],
                 covered, missing, added, depth4, depth6, worst);
    }
  }
}
