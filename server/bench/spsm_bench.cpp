// sundial-bench-spsm: maps that hold triangles against plain maps of the same texels, as [Lecocq et al. 2014,
// section 6] compares them, and shadow volumes against shadow rays.
//
//   [RUNS [SCENE...]]     builtin:NAME or a glTF file; without any: knot, city, atrium, trees
//
// A line a scene, picture and map size: wrong pixels in %, times over sm's, and what they consist of.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>

#include "bench/need.h"
#include "renderer.h"
#include "scene/choose.h"
#include "scene/load.h"
#include "shadow/shadow_volumes.h"

namespace sundial::bench {

namespace {

constexpr std::string_view kBuiltin = "builtin:";
constexpr std::array<glm::uvec2, 2> kPictures{{{1024, 1024}, {1920, 1080}}};

// What the rows share; texels are those of one map.
std::vector<std::string> methodsAt(int texels) {
  const std::string size = fmt::format(",texels={}", texels);
  return {"sm" + size,
          "spsm" + size,
          "spsm,storage=depth-id" + size,
          "spsm,recovery=off" + size,
          "rgsm,kernel=5" + size,
          fmt::format("sdsm-log,storage=triangle,lookup=spsm,texels={}", texels / 2)};
}
constexpr std::string_view kHead = "sm      spsm    sm/spsm ids     off     rgsm 5  sdsm    ";

struct Sink final : JobSink {
  std::vector<MethodResult> results;
  void onPlan(std::size_t, const std::vector<PlanView>&) override {}
  void onImage(std::size_t, Image) override {}
  void onResult(std::size_t, MethodResult result) override { results.push_back(std::move(result)); }
};

double wrongPercent(const MethodResult& result) { return 100 * (1 - result.measures->pixelMatch); }

const PassTiming& pass(const MethodResult& result, std::string_view name) {
  for (const PassTiming& timing : result.passes)
    if (timing.name == name) return timing;
  throw std::runtime_error(fmt::format("{} has no pass {}", result.method.label(), name));
}

// Of the samples that a lookup answered.
double uncertainPercent(const MethodResult& result) {
  double uncertain = 0, all = 0;
  for (const Work& work : pass(result, "resolve").work)
    for (const char* found : {"one_triangle", "neighbours", "uncertain"})
      if (work.name == found) {
        all += work.count;
        if (work.name == "uncertain") uncertain = work.count;
      }
  return all > 0 ? 100 * uncertain / all : 0;
}

std::vector<MethodResult> resultsOf(Renderer& renderer, RenderJob job,
                                    const std::vector<std::string>& methods) {
  for (const std::string& text : methods) job.methods.push_back(need(parseMethod(text)));
  if (job.repetitions > 0) job.baseline = job.methods.front();
  Sink sink;
  need(renderer.run(job, {}, sink));
  return std::move(sink.results);
}

void printMaps(Renderer& renderer, const RenderJob& job, const std::string& scene) {
  fmt::print("{:18} picture   texels  {}spsm/sm ids/sm  sdsm/sm store   pack    resolve uncertain\n", scene,
             kHead);
  for (const int texels : {512, 1024, 2048, 4096}) {
    const auto results = resultsOf(renderer, job, methodsAt(texels));
    fmt::print("{:18} {:<9} {:<7}", scene, fmt::format("{}x{}", job.size.x, job.size.y), texels);
    for (std::size_t m = 0; m < results.size(); ++m) {
      fmt::print(" {:<7.4f}", wrongPercent(results[m]));
      if (m == 1) fmt::print(" {:<7.2f}", wrongPercent(results[0]) / wrongPercent(results[1]));
    }
    for (const std::size_t m : {1, 2, 5})
      fmt::print(" {:<7.2f}", results[m].ratio ? results[m].ratio->median : 0);
    for (const char* name : {"store", "pack", "resolve"})
      fmt::print(" {:<7.1f}", pass(results[1], name).gpuMs.median);
    fmt::print(" {:.2f} %\n", uncertainPercent(results[1]));
    std::fflush(stdout);
  }
}

void printVolumes(Renderer& renderer, RenderJob job, const std::string& scene) {
  if (const auto why = whyNoVolumes(*job.scene)) {
    fmt::print("{:18} no shadow volumes: alpha test\n", scene);
    return;
  }
  job.repetitions = 0;
  fmt::print("{:18} {}x{}  shadow-volumes and rays differ in {:.5f} %\n", scene, job.size.x, job.size.y,
             wrongPercent(resultsOf(renderer, job, {"shadow-volumes"}).front()));
}

Scene load(const std::string& reference) {
  if (reference.starts_with(kBuiltin)) return need(makeBuiltin(reference.substr(kBuiltin.size())));
  return need(parseGltf(need(readSceneFiles(reference))));
}

int run(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 5;
  if (runs < 0 || (argc > 1 && *argv[1] > '9')) {
    fmt::print(stderr, "sundial-bench-spsm: give [RUNS [SCENE...]]: RUNS of each method, 0 for no times\n");
    return 2;
  }
  std::vector<std::string> scenes(argv + std::min(argc, 2), argv + argc);
  if (scenes.empty()) scenes = {"builtin:knot", "builtin:city", "builtin:atrium", "builtin:trees"};
  const auto renderer = need(Renderer::create("", false));
  for (const std::string& name : scenes) {
    RenderJob job{.scene = std::make_shared<const Scene>(load(name)), .methods = {}, .baseline = {}};
    job.view = need(chooseView(*job.scene, std::nullopt));
    job.light = need(chooseLight(*job.scene, std::nullopt));
    job.measures = true;
    job.repetitions = static_cast<unsigned>(runs);
    const std::string shown = name.substr(name.find_last_of(":/") + 1);
    for (const glm::uvec2& size : kPictures) {
      job.size = size;
      printMaps(*renderer, job, shown);
      printVolumes(*renderer, job, shown);
    }
  }
  return 0;
}

}  // namespace

}  // namespace sundial::bench

int main(int argc, char** argv) {
  try {
    return sundial::bench::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "sundial-bench-spsm: {}\n", error.what());
    return 1;
  }
}
