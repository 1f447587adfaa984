#include "bench/results.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/program.h"

namespace sundial::bench {

namespace {

struct Collector final : JobSink {
  std::vector<MethodResult> results;
  void onPlan(std::size_t, const std::vector<PlanView>&) override {}
  void onImage(std::size_t, Image) override {}
  void onResult(std::size_t, MethodResult result) override { results.push_back(std::move(result)); }
};

}  // namespace

RenderJob jobAt(const Sight& sight, glm::uvec2 size, const std::vector<std::string>& methods, unsigned runs) {
  RenderJob job{.scene = sight.scene,
                .view = sight.view,
                .light = sight.light,
                .size = size,
                .methods = {},
                .baseline = {},
                .repetitions = runs,
                .measures = true};
  for (const std::string& text : methods) job.methods.push_back(need(parseMethod(text)));
  if (runs > 0) job.baseline = job.methods.front();
  return job;
}

std::vector<MethodResult> resultsOf(Renderer& renderer, const RenderJob& job) {
  Collector collector;
  need(renderer.run(job, {}, collector));
  return std::move(collector.results);
}

double wrongPercent(const MethodResult& result) { return 100 * (1 - result.measures->pixelMatch); }

const PassTiming& passOf(const MethodResult& result, std::string_view name) {
  const auto found = std::ranges::find(result.passes, name, &PassTiming::name);
  if (found == result.passes.end())
    throw std::runtime_error(fmt::format("{} has no pass {}", result.method.label(), name));
  return *found;
}

}  // namespace sundial::bench
