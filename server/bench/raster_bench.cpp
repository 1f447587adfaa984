// sundial-bench-raster: the compute rasteriser against the pipeline, on built-in scenes.
//
//   ratios [RUNS]            times of the store pass, as ratios: what raster=auto rests on
//   conservative [RUNS]      all that triangles touch: by compute, and grown by a geometry shader
//   check                    every scene, map size and light, texel for texel
//   time SCENE VIEW LIGHT RUNS METHOD...   the store passes of these methods, against the first
#include <fmt/format.h>

#include <string_view>

#include "bench/fragment_store.h"
#include "bench/frame_scene.h"
#include "bench/map_comparison.h"
#include "bench/program.h"
#include "shadow/linear_store.h"

namespace sundial::bench {

namespace {

constexpr glm::uvec2 kSize{1024, 1024};  // of the view, whose samples fit some methods' maps

// Of a built-in scene, without "builtin:".
FrameScene sceneAt(const Device& device, FramePipelines& pipelines, Place place) {
  place.scene = "builtin:" + place.scene;
  return {device, pipelines, sightOf(place), kSize};
}

std::unique_ptr<Store> conservative(const Device& device, FramePipelines& pipelines, const Method& method,
                                    const shared::FrameConstants& constants) {
  return std::make_unique<LinearStore>(device, pipelines, method, constants,
                                       RasterChoice{.coverage = shared::kCoverConservative});
}

std::unique_ptr<Store> byFragments(const Device& device, FramePipelines& pipelines, const Method& method,
                                   const shared::FrameConstants&) {
  return std::make_unique<FragmentStore>(device, pipelines, method);
}

std::unique_ptr<Store> byGeometryShader(const Device& device, FramePipelines& pipelines, const Method& method,
                                        const shared::FrameConstants&) {
  return std::make_unique<FragmentStore>(device, pipelines, method, true);
}

// One map of the whole scene: by the pipeline, by compute, with triangles, and conservatively.
void printPayloads(const Device& device, const FrameScene& scene, const Place& place, int runs) {
  for (const int texels : {512, 1024, 2048, 4096}) {
    const auto pipeline = scene.frame(fmt::format("sm,texels={},raster=pipeline", texels));
    const std::string text = fmt::format("sm,texels={},raster=compute", texels);
    const auto plain = scene.frame(text), wide = scene.frame(text, conservative);
    const auto ids = scene.frame(fmt::format("id,texels={},lookup=hard", texels));
    const auto ms = storeTimes(device, {pipeline.get(), plain.get(), ids.get(), wide.get()}, runs);
    fmt::print(
        "{:8} {:5}  pipeline {:7.1f} ms  compute/pipeline {:.2f}  id/compute {:.2f}  conservative/compute "
        "{:.2f}\n",
        place.scene, texels, median(ms[0]), ratio(ms[1], ms[0]), ratio(ms[2], ms[1]), ratio(ms[3], ms[1]));
    std::fflush(stdout);
  }
}

void printChoices(const Device& device, const FrameScene& scene, const Place& place, int runs) {
  for (const char* row : {"sm", "csm", "sdsm-log", "dv"})
    for (const int texels : {256, 512, 1024, 2048}) {
      const auto frame = [&](const char* raster) {
        return scene.frame(fmt::format("{},texels={},raster={}", row, texels, raster));
      };
      const auto pipeline = frame("pipeline"), compute = frame("compute"), automatic = frame("auto");
      const auto ms = storeTimes(device, {pipeline.get(), compute.get()}, runs);
      const bool byCompute = automatic->drawsByCompute();
      const double choice = ratio(ms[1], ms[0]);
      fmt::print("{:8} {:8} {:5}  compute/pipeline {:.2f}  auto: {:8}  auto/better {:.2f}\n", place.scene,
                 row, texels, choice, byCompute ? "compute" : "pipeline",
                 byCompute ? std::max(choice, 1.0) : std::max(1 / choice, 1.0));
      std::fflush(stdout);
    }
}

void printTiles(const Device& device, const FrameScene& scene, const Place& place, int runs) {
  const auto cascades = scene.frame("csm"), tiles = scene.frame("iasm"),
             papers = scene.frame("iasm", byFragments);
  const auto ms = storeTimes(device, {cascades.get(), tiles.get(), papers.get()}, runs);
  fmt::print("{:8} iasm/csm {:.2f}  iasm by fragments' atomics/csm {:.2f}\n", place.scene,
             ratio(ms[1], ms[0]), ratio(ms[2], ms[0]));
}

int printRatios(const Device& device, FramePipelines& pipelines, int runs) {
  for (const Place& place :
       {Place{"atrium", "main", "sun"}, {"trees", "walk", "sun"}, {"village", "fence", "noon"}}) {
    const FrameScene scene = sceneAt(device, pipelines, place);
    printPayloads(device, scene, place, runs);
    printTiles(device, scene, place, runs);
    printChoices(device, scene, place, runs);
  }
  return 0;
}

// What conservative coverage costs over plain coverage by compute, and in which texels the two ways differ.
int printConservative(const Device& device, FramePipelines& pipelines, int runs) {
  if (!device.hasGeometryShaders()) throw std::runtime_error("this device has no geometry shaders");
  for (const char* name : {"knot", "grid", "city"}) {
    const FrameScene scene = sceneAt(device, pipelines, {name});
    for (const int texels : {512, 1024, 2048, 4096}) {
      const std::string text = fmt::format("sm,texels={},raster=compute", texels);
      const auto plain = scene.frame(text), byCompute = scene.frame(text, conservative),
                 grown = scene.frame(text, byGeometryShader);
      const auto ms = storeTimes(device, {plain.get(), byCompute.get(), grown.get()}, runs);
      const Differences d = differences(*byCompute, *grown);
      fmt::print(
          "{:6} {:5}  compute {:7.1f} ms  conservative/compute {:.2f}  geometry shader/compute {:.2f}  "
          "covered "
          "{}  geometry shader misses {}, adds {}\n",
          name, texels, median(ms[0]), ratio(ms[1], ms[0]), ratio(ms[2], ms[0]), d.covered, d.missing,
          d.added);
      std::fflush(stdout);
    }
  }
  return 0;
}

int check(const Device& device, FramePipelines& pipelines) {
  bool same = true;
  for (const Place& place : {Place{"atrium", "main", "sun"},
                             {"atrium", "main", "spot"},
                             {"trees", "walk", "sun"},
                             {"trees", "walk", "spot"},
                             {"village", "fence", "noon"},
                             {"observatory", "", ""},
                             {"conference", "", ""},
                             {"knot", "", ""},
                             {"city", "", ""},
                             {"grid", "low", "low"}}) {
    const FrameScene scene = sceneAt(device, pipelines, place);
    for (const char* row : {"sm", "sdsm-log", "csm"})
      for (const int texels : {512, 1024, 2048, 4096}) {
        const auto frame = [&](const char* raster) {
          return scene.frame(fmt::format("{},texels={},raster={}", row, texels, raster));
        };
        // Four maps of 4096 are more than a buffer of 128 MiB holds.
        const auto text = fmt::format("{},texels={},raster=compute", row, texels);
        if (const auto method = parseMethod(text); method && whyTooLarge(*method, device)) {
          fmt::print("{:11} {:4} {:8} {:5}  too large for a buffer\n", place.scene, place.light, row, texels);
          continue;
        }
        const Differences d = differences(*frame("pipeline"), *frame("compute"));
        same = same && d.missing == 0 && d.added == 0 && d.far == 0;
        fmt::print(
            "{:11} {:4} {:8} {:5}  covered {:9}  missing {}  added {}  depth off by 1e-4 {}  by the "
            "pipeline's division by zero {}\n",
            place.scene, place.light, row, texels, d.covered, d.missing, d.added, d.far, d.byZero);
        std::fflush(stdout);
      }
  }
  return same ? 0 : 1;
}

int time(const Device& device, FramePipelines& pipelines, const Arguments& arguments) {
  const FrameScene scene = sceneAt(device, pipelines, {arguments[1], arguments[2], arguments[3]});
  const std::span methods = std::span(arguments).subspan(5);
  std::vector<std::unique_ptr<Frame>> owned;
  std::vector<Frame*> frames;
  for (const std::string& method : methods) frames.push_back(owned.emplace_back(scene.frame(method)).get());
  const auto ms =
      storeTimes(device, frames, std::max(static_cast<int>(countOf(arguments[4]).value_or(1)), 1));
  for (std::size_t f = 0; f < frames.size(); ++f)
    fmt::print("{:40} {:8.2f} ms  ratio {:.2f}\n", methods[f], median(ms[f]), ratio(ms[f], ms[0]));
  return 0;
}

int run(const Arguments& arguments) {
  const std::string mode = arguments.empty() ? "" : arguments[0];
  const auto runs = arguments.size() < 2 ? std::optional(5u) : countOf(arguments[1]);
  const bool timesAll =
      (mode == "ratios" || mode == "conservative") && arguments.size() <= 2 && runs.value_or(0) > 0;
  if (!timesAll && (mode != "check" || arguments.size() > 1) && (mode != "time" || arguments.size() < 6))
    throw WrongArguments(
        "give ratios [RUNS], conservative [RUNS], check, or time SCENE VIEW LIGHT RUNS METHOD...");
  const auto device = need(Device::create("", false, ShaderStages::all));
  FramePipelines pipelines(*device);
  if (mode == "check") return check(*device, pipelines);
  if (mode == "time") return time(*device, pipelines, arguments);
  return mode == "ratios" ? printRatios(*device, pipelines, static_cast<int>(*runs))
                          : printConservative(*device, pipelines, static_cast<int>(*runs));
}

}  // namespace

}  // namespace sundial::bench

int main(int argc, char** argv) {
  return sundial::bench::runProgram("sundial-bench-raster", argc, argv, sundial::bench::run);
}
