// sundial-bench-warp: fitted and warped maps against plain ones, as [NOTW, section 4] compares them.
//
//   [RUNS [SCENE...]]      SCENE: files that are counted after the built-in scenes
//   tessellation [RUNS]    warped maps by the pipeline, as they are and cut up, against the warp's inverse
//
// RUNS: timed frames of each method, 0 for no times.
// Prints the tables of server/shadow/README.md under "Warps".
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <span>

#include "bench/program.h"
#include "bench/results.h"
#include "bench/warp_tessellation.h"
#include "bench/warped_samples.h"

namespace sundial::bench {

namespace {

constexpr glm::uvec2 kPicture{1024, 1024};
constexpr int kTexels = 512;

const std::vector<Place> kTimed = {
    {"builtin:observatory", "", "spot"}, {"builtin:conference", "", "spot"}, {"builtin:atrium", "", "sun"}};
const std::vector<std::string> kTimedMethods = {"sm", "msf", "dv", "rtw", "notw"};

const std::vector<Place> kCounted = {{"builtin:observatory", "", "spot"},
                                     {"builtin:observatory", "", "sun"},
                                     {"builtin:conference", "", "spot"},
                                     {"builtin:conference", "", "sun"},
                                     {"builtin:atrium", "", "sun"},
                                     {"builtin:atrium", "", "spot"},
                                     {"builtin:trees", "walk"},
                                     {"builtin:trees", "main"},
                                     {"builtin:village"},
                                     {"builtin:city"},
                                     {"builtin:knot"}};
const std::vector<std::string> kCountedMethods = {
    "sm", "msf", "dv", "rtw", "rtw,analysis=hybrid", "rtw,analysis=forward", "notw"};

const std::vector<Place> kSpread = {{"builtin:atrium", "", "sun"},
                                    {"builtin:observatory", "", "spot"},
                                    {"builtin:conference", "", "spot"},
                                    {"builtin:trees?count=40", "walk", "low"}};
// Spreads samples more evenly than the row does.
std::string evenMethod(int texels) { return fmt::format("notw,power=0.7,even=0.01,window={}", texels / 14); }

// The last gives each sample its share wherever it lies: what it leaves in their counts is the pixels' grid.
std::vector<std::string> spreadMethods(int texels) {
  return {"rtw", "notw", evenMethod(texels), "notw,power=1,even=0.01,window=1"};
}

// Whether shadows' edges lie along texels decides much of what a single size shows.
constexpr std::array kSizes = {480, 496, 512, 528, 544, 560};
std::vector<std::string> sizedMethods(int texels) {
  return {"sm", "msf", "dv", "rtw", "notw", evenMethod(texels)};
}

std::vector<std::string> withTexels(std::vector<std::string> methods, int texels = kTexels) {
  for (std::string& method : methods) method += fmt::format(",texels={}", texels);
  return methods;
}

std::string nameOf(const Place& place) {
  std::string name = fmt::format("`{}`", shortName(place.scene));
  for (const std::string& part : {place.view, place.light})
    if (!part.empty()) name += ", " + part;
  return name;
}

std::vector<Place> withFiles(std::vector<Place> places, const std::vector<std::string>& files) {
  for (const std::string& file : files) places.push_back({file});
  return places;
}

void printHead(std::string_view first, const std::vector<std::string>& columns) {
  fmt::print("| {:28} |", first);
  for (const std::string& column : columns) fmt::print(" {} |", column);
  fmt::print("\n| --- |");
  for (std::size_t i = 0; i < columns.size(); ++i) fmt::print(" --- |");
  fmt::print("\n");
}

void endRow() {
  fmt::print("\n");
  std::fflush(stdout);
}

void printTimes(Renderer& renderer, unsigned runs) {
  fmt::print("Frame time over sm's, and the share of `warp` in it\n\n");
  printHead("scene, light", {kTimedMethods.begin() + 1, kTimedMethods.end()});
  for (const Place& place : kTimed) {
    RenderJob job = jobAt(sightOf(place), kPicture, withTexels(kTimedMethods), runs);
    job.measures = false;
    const auto results = resultsOf(renderer, job);
    fmt::print("| {:28} |", nameOf(place));
    for (std::size_t m = 1; m < results.size(); ++m) {
      fmt::print(" {:.2f}", results[m].ratio->median);
      if (results[m].method.stages->warp != Warp::none)
        fmt::print(" ({:.0f} %)", 100 * passOf(results[m], "warp").gpuMs.median / results[m].frameMs.median);
      fmt::print(" |");
    }
    endRow();
  }
  fmt::print("\n");
}

void printWrong(Renderer& renderer, const std::vector<std::string>& files) {
  fmt::print("Wrong pixels, %\n\n");
  printHead("scene, view, light", kCountedMethods);
  for (const Place& place : withFiles(kCounted, files)) {
    const auto results = resultsOf(renderer, jobAt(sightOf(place), kPicture, withTexels(kCountedMethods), 0));
    fmt::print("| {:28} |", nameOf(place));
    for (const MethodResult& result : results) fmt::print(" {:.3f} |", wrongPercent(result));
    endRow();
  }
  fmt::print("\n");
}

void printMeans(Renderer& renderer, const std::vector<std::string>& files) {
  fmt::print("Wrong pixels, %, means of maps of {} texels a side\n\n", fmt::join(kSizes, ", "));
  printHead("scene, view, light", sizedMethods(kTexels));
  for (const Place& place : withFiles(kCounted, files)) {
    std::vector<std::string> methods;
    for (const int texels : kSizes)
      std::ranges::copy(withTexels(sizedMethods(texels), texels), std::back_inserter(methods));
    const auto results = resultsOf(renderer, jobAt(sightOf(place), kPicture, methods, 0));
    std::vector<double> sums(results.size() / kSizes.size());
    for (std::size_t m = 0; m < results.size(); ++m) sums[m % sums.size()] += wrongPercent(results[m]);
    fmt::print("| {:28} |", nameOf(place));
    for (const double sum : sums) fmt::print(" {:.3f} |", sum / kSizes.size());
    endRow();
  }
  fmt::print("\n");
}

// How much samples per texel vary after the warp of a method, over how much they do before it; a pixel is cut
// into so many.
double variationLeft(const FrameScene& scene, const Method& method, unsigned side) {
  const Warped warped = warpedOf(scene, method, side).front();
  return variation(countsAfter(warped)) / variation(countsBefore(warped));
}

void printSpread(Renderer& renderer, const std::vector<std::string>& files, int texels) {
  fmt::print(
      "{0} x {0} texels: variation of samples per texel after the warp over that before, with one sample a "
      "pixel, and with sixteen; wrong pixels, %\n\n",
      texels);
  const auto device = need(Device::create("", false));
  FramePipelines pipelines(*device);
  const std::vector<std::string> methods = spreadMethods(texels);
  printHead("scene, view, light", methods);
  for (const Place& place : withFiles(kSpread, files)) {
    const Sight sight = sightOf(place);
    const FrameScene scene(*device, pipelines, sight, kPicture);
    fmt::print("| {:28} |", nameOf(place));
    for (const MethodResult& result :
         resultsOf(renderer, jobAt(sight, kPicture, withTexels(methods, texels), 0)))
      fmt::print(" {:.3f}, {:.3f}, {:.3f} |", variationLeft(scene, result.method, 1),
                 variationLeft(scene, result.method, 4), wrongPercent(result));
    endRow();
  }
  fmt::print("\n");
}

int run(const Arguments& arguments) {
  const bool tessellates = !arguments.empty() && arguments[0] == "tessellation";
  const std::span rest = std::span(arguments).subspan(tessellates ? 1 : 0);
  const auto runs = rest.empty() ? std::optional(5u) : countOf(rest[0]);
  if (!runs || (tessellates && rest.size() > 1))
    throw WrongArguments(
        "give [RUNS [SCENE...]] or tessellation [RUNS]: RUNS timed frames of each method, 0 for no times; "
        "glTF files");
  if (tessellates) {
    printTessellation(*runs);
    return 0;
  }
  const auto renderer = need(Renderer::create("", false));
  if (*runs > 0) printTimes(*renderer, *runs);
  const std::vector<std::string> files(rest.begin() + (rest.empty() ? 0 : 1), rest.end());
  printWrong(*renderer, files);
  printMeans(*renderer, files);
  for (const int texels : {256, kTexels}) printSpread(*renderer, files, texels);
  return 0;
}

}  // namespace

}  // namespace sundial::bench

int main(int argc, char** argv) {
  return sundial::bench::runProgram("sundial-bench-warp", argc, argv, sundial::bench::run);
}
