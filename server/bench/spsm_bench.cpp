// sundial-bench-spsm: maps that hold triangles against plain maps of the same texels, as [Lecocq et al. 2014,
// section 6] compares them, and shadow volumes against shadow rays.
//
//   [RUNS [SCENE...]]     builtin:NAME or a glTF file; without any: knot, city, atrium, trees
//
// A line a scene, picture and map size: wrong pixels in %, times over sm's, and what they consist of.
#include <fmt/format.h>

#include <array>
#include <cstdio>

#include "bench/program.h"
#include "bench/results.h"
#include "shadow/shadow_volumes.h"

namespace sundial::bench {

namespace {

constexpr std::array<glm::uvec2, 2> kPictures{{{1024, 1024}, {1920, 1080}}};

// What the rows share; texels are those of one map.
std::vector<std::string> methodsAt(int texels) {
  const std::string size = fmt::format(",texels={}", texels);
  return {"sm" + size,
          "spsm" + size,
          "spsm,storage=depth-id" + size,
          "spsm,recovery=edges" + size,
          "spsm,recovery=edges,storage=depth-id" + size,
          "spsm,recovery=off" + size,
          "rgsm,kernel=5" + size,
          fmt::format("sdsm-log,storage=triangle,lookup=spsm,texels={}", texels / 2)};
}
constexpr std::string_view kHead = "sm      spsm    sm/spsm ids     edges   edg ids off     rgsm 5  sdsm    ";

// Of the samples that a lookup answered.
double uncertainPercent(const MethodResult& result) {
  double uncertain = 0, all = 0;
  for (const Work& work : passOf(result, "resolve").work)
    for (const char* found : {"one_triangle", "neighbours", "uncertain"})
      if (work.name == found) {
        all += work.count;
        if (work.name == "uncertain") uncertain = work.count;
      }
  return all > 0 ? 100 * uncertain / all : 0;
}

void printMaps(Renderer& renderer, const Sight& sight, glm::uvec2 size, unsigned runs,
               const std::string& scene) {
  fmt::print("{:18} picture   texels  {}spsm/sm ids/sm  edges   sdsm/sm store   pack    resolve uncertain\n",
             scene, kHead);
  for (const int texels : {512, 1024, 2048, 4096}) {
    const auto results = resultsOf(renderer, jobAt(sight, size, methodsAt(texels), runs));
    fmt::print("{:18} {:<9} {:<7}", scene, fmt::format("{}x{}", size.x, size.y), texels);
    for (std::size_t m = 0; m < results.size(); ++m) {
      fmt::print(" {:<7.4f}", wrongPercent(results[m]));
      if (m == 1) fmt::print(" {:<7.2f}", wrongPercent(results[0]) / wrongPercent(results[1]));
    }
    for (const std::size_t m : {1, 2, 3, 7})
      fmt::print(" {:<7.2f}", results[m].ratio ? results[m].ratio->median : 0);
    for (const char* name : {"store", "pack", "resolve"})
      fmt::print(" {:<7.1f}", passOf(results[1], name).gpuMs.median);
    fmt::print(" {:.2f} %\n", uncertainPercent(results[1]));
    std::fflush(stdout);
  }
}

void printVolumes(Renderer& renderer, const Sight& sight, glm::uvec2 size, const std::string& scene) {
  if (const auto why = whyNoVolumes(*sight.scene)) {
    fmt::print("{:18} no shadow volumes: alpha test\n", scene);
    return;
  }
  fmt::print("{:18} {}x{}  shadow-volumes and rays differ in {:.5f} %\n", scene, size.x, size.y,
             wrongPercent(resultsOf(renderer, jobAt(sight, size, {"shadow-volumes"}, 0)).front()));
}

int run(const Arguments& arguments) {
  const auto runs = arguments.empty() ? std::optional(5u) : countOf(arguments[0]);
  if (!runs) throw WrongArguments("give [RUNS [SCENE...]]: RUNS of each method, 0 for no times");
  Arguments scenes(arguments.begin() + std::min<std::ptrdiff_t>(1, std::ssize(arguments)), arguments.end());
  if (scenes.empty()) scenes = {"builtin:knot", "builtin:city", "builtin:atrium", "builtin:trees"};
  const auto renderer = need(Renderer::create("", false));
  for (const std::string& name : scenes) {
    const Sight sight = sightOf({name});
    for (const glm::uvec2& size : kPictures) {
      printMaps(*renderer, sight, size, *runs, shortName(name));
      printVolumes(*renderer, sight, size, shortName(name));
    }
  }
  return 0;
}

}  // namespace

}  // namespace sundial::bench

int main(int argc, char** argv) {
  return sundial::bench::runProgram("sundial-bench-spsm", argc, argv, sundial::bench::run);
}
