#include "bench/warp_tessellation.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "bench/frame_scene.h"
#include "bench/map_comparison.h"
#include "bench/program.h"
#include "bench/tessellated_store.h"

namespace sundial::bench {

namespace {

constexpr glm::uvec2 kPicture{1024, 1024};
const std::vector<Place> kPlaces = {
    {"builtin:observatory", "", "spot"}, {"builtin:conference", "", "spot"}, {"builtin:atrium", "", "sun"}};

// A way to draw the map of one method.
struct Way {
  std::string_view name, raster;
  MakeStore* make = makeStore;
};
constexpr Way kInverse{"inverse", "compute"};
constexpr Way kWays[] = {{"vertex shader", "pipeline"},
                         {"pieces of 16 texels", "pipeline", makeTessellated<16>},
                         {"pieces of 4 texels", "pipeline", makeTessellated<4>},
                         kInverse};

// By more than the width of two texels, which bias allows for.
bool beyondBias(LightKind light, const shared::ShadowView& view, float a, float b) {
  const bool far = light == LightKind::directional;
  const auto distance = [&](float depth) {
    const double z = std::lerp(double(view.lsMin.z), double(view.lsMax.z), double(depth));
    return far ? z : 1 / std::max(z, 1e-30);  // light space, or metres
  };
  const double width = std::max(view.texelSize.x, view.texelSize.y) * (far ? 1 : distance(b));
  return std::abs(distance(a) - distance(b)) > 2 * width;
}

struct Seen {
  std::unique_ptr<Frame> frame;
  std::vector<float> visibility;
};
Seen see(const FrameScene& scene, std::string_view row, const Way& way) {
  auto frame = scene.frame(fmt::format("{},texels=512,raster={}", row, way.raster), way.make);
  return {std::move(frame), scene.visibility()};
}

double percentOfPixels(const std::vector<float>& visibility, const std::vector<float>& truth,
                       const std::vector<shared::ViewSample>& samples) {
  std::size_t wrong = 0, all = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].instance == shared::kNoInstance) continue;
    ++all;
    wrong += std::round(visibility[i]) != std::round(truth[i]);
  }
  return 100.0 * static_cast<double>(wrong) / static_cast<double>(std::max<std::size_t>(all, 1));
}

// Of those that either map covers.
double percentOfTexels(const Differences& d) {
  return 100.0 * static_cast<double>(d.missing + d.added + d.far + d.byZero) /
         static_cast<double>(std::max<std::size_t>(d.covered + d.added, 1));
}

// What one method's ways give, beside a plain map.
void printWays(const FrameScene& scene, const Place& place, LightKind light, std::string_view row,
               Frame& plain, const std::vector<float>& truth, unsigned runs) {
  const Seen inverse = see(scene, row, kInverse);
  const auto samples = scene.samples();
  const auto differ = [&](const shared::ShadowView& view, float a, float b) {
    return beyondBias(light, view, a, b);
  };
  for (const Way& way : kWays) {
    const Seen seen = see(scene, row, way);
    fmt::print("| `{}` | `{}` | {} |", shortName(place.scene), row, way.name);
    if (runs > 0) {
      const std::vector<Frame*> pair{&plain, seen.frame.get()};
      const auto frames = frameTimes(scene.device(), pair, static_cast<int>(runs)),
                 stores = storeTimes(scene.device(), pair, static_cast<int>(runs));
      fmt::print(" {:.2f} | {:.2f} |", ratio(frames[1], frames[0]), ratio(stores[1], stores[0]));
    }
    const bool byInverse = seen.frame->drawsByCompute();
    fmt::print(" {:.3f} | {:.2f} |\n", percentOfPixels(seen.visibility, truth, samples),
               byInverse ? 0 : percentOfTexels(differences(*seen.frame, *inverse.frame, differ)));
    std::fflush(stdout);
  }
}

}  // namespace

void printTessellation(unsigned runs) {
  const auto device = need(Device::create("", false, ShaderStages::all));
  if (!device->hasTessellationShaders()) throw std::runtime_error("this device has no tessellation shaders");
  FramePipelines pipelines(*device);
  fmt::print(
      "Times over sm's; texels that differ from the inverse's by more than two texels' width, or that one of "
      "the two "
      "covers alone\n\n| scene | method | by | {}wrong pixels, % | texels, % |\n",
      runs > 0 ? "frame | store | " : "");
  fmt::print("| --- | --- | --- | {}--- | --- |\n", runs > 0 ? "--- | --- | " : "");
  for (const Place& place : kPlaces) {
    const Sight sight = sightOf(place);
    const FrameScene scene(*device, pipelines, sight, kPicture);
    const auto plain = scene.frame("sm,texels=512");
    const auto truth = scene.reference();
    for (const char* row : {"rtw", "notw"})
      printWays(scene, place, sight.light.kind, row, *plain, truth, runs);
  }
}

}  // namespace sundial::bench
