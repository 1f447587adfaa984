#include "bench/raster_scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/need.h"
#include "scene/choose.h"
#include "scene/load.h"
#include "shadow/camera.h"
#include "shadow/frame_runner.h"

namespace sundial::bench {

namespace {

constexpr glm::uvec2 kSize{1024, 1024};  // of the view, whose samples fit some methods' maps

std::optional<std::string> named(const std::string& name) {
  return name.empty() ? std::nullopt : std::optional(name);
}

}  // namespace

RasterScene::RasterScene(const Device& device, FramePipelines& pipelines, const std::string& scene,
                         const std::string& view, const std::string& light)
    : device_(device),
      pipelines_(pipelines),
      scene_(std::make_shared<const Scene>(need(makeBuiltin(scene)))),
      target_(device, kSize),
      buffers_(device, scene_),
      view_(need(chooseView(*scene_, named(view)))),
      light_(need(chooseLight(*scene_, named(light)))) {
  light_.direction = glm::normalize(light_.direction);
  buffers_.moveTo(device_, frameOrigin(*scene_, view_));
}

std::unique_ptr<Frame> RasterScene::frame(std::string_view text, MakeStore* make) const {
  const glm::dvec3 origin = frameOrigin(*scene_, view_);
  auto made = std::make_unique<Frame>(
      FrameView{.device = device_,
                .pipelines = pipelines_,
                .scene = buffers_,
                .target = target_,
                .reference = nullptr,
                .edges = nullptr,
                .light = light_,
                .origin = origin,
                .constants = frameConstants(*scene_, view_, light_, target_.size(), origin)},
      need(parseMethod(text)), make);
  need(runFrame(device_, made->passes(), {}));
  return made;
}

std::vector<std::vector<double>> storeTimes(const Device& device, const std::vector<Frame*>& frames,
                                            int runs) {
  std::vector<std::vector<double>> ms(frames.size());
  for (int run = -1; run < runs; ++run)
    for (std::size_t f = 0; f < frames.size(); ++f) {
      std::vector<Pass> passes = frames[f]->passes();
      std::erase_if(passes, [](const Pass& pass) { return pass.name != "store"; });
      const double taken = need(runFrame(device, passes, {})).frameMs;
      if (run >= 0) ms[f].push_back(taken);
    }
  return ms;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

double ratio(const std::vector<double>& of, const std::vector<double>& to) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < of.size(); ++i) ratios.push_back(of[i] / to[i]);
  return median(std::move(ratios));
}

Differences differences(const Frame& image, const Frame& linear) {
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
        found.far += !byZero && std::abs(a - b) > 1e-4f;
      }
  }
  return found;
}

}  // namespace sundial::bench
