#include "bench/warped_samples.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace sundial::bench {

using glm::dvec2;
using glm::dvec3;

namespace {

double valueAt(const float* table, double position, unsigned last) {
  const double at = std::clamp(position, 0.0, double(last));
  const auto k = std::min(static_cast<unsigned>(at), last - 1);
  return std::lerp(double(table[k]), double(table[k + 1]), at - k);
}

// Between the two functions of `count` whose middles are around `beside`.
template <class Table>
double between(Table table, std::size_t count, double beside, double position, unsigned last) {
  const double at = std::clamp(beside - 0.5, 0.0, double(count - 1));
  const auto first = static_cast<std::size_t>(at);
  return std::lerp(valueAt(table(first), position, last),
                   valueAt(table(std::min(first + 1, count - 1)), position, last), at - double(first));
}

// Those that face the light, before any warp: in the plan's only map, or each in its face's.
void takeSamples(std::vector<Warped>& warps, const FrameScene& scene, const shared::Plan& plan) {
  const std::vector<shared::ViewSample> samples = scene.samples();
  const std::vector<std::uint8_t> faces = scene.facing();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!faces[i]) continue;
    const glm::vec4 light(glm::dmat4(plan.lightFromWorld) * glm::dvec4(dvec3(samples[i].wsPosition), 1));
    const std::uint32_t view = warps.size() == shared::kCubeFaces ? shared::faceOf(light) : 0;
    const glm::dvec4 ls(shared::faceFromLight(view, light));
    const dvec2 low(plan.views[view].lsMin), high(plan.views[view].lsMax);
    const dvec2 share = (dvec2(ls) / ls.w - low) / (high - low);
    warps[view].samples.push_back(dvec2(share.x, 1 - share.y) * dvec2(warps[view].size));  // rows run down
  }
}

template <class Position>
std::vector<double> counts(const Warped& warped, const Position& position) {
  std::vector<double> found(std::size_t{warped.size.x} * warped.size.y);
  for (const dvec2& sample : warped.samples) {
    const glm::uvec2 texel = glm::min(glm::uvec2(position(sample)), warped.size - 1u);
    ++found[std::size_t{texel.y} * warped.size.x + texel.x];
  }
  return found;
}

}  // namespace

dvec2 Warped::centre(unsigned x, unsigned y) const {
  if (rows == 1) return {centres[x].x, centres[size.x + y].x};
  return dvec2(centres[std::size_t{y} * size.x + x]);
}

dvec2 Warped::operator()(const dvec2& from) const {
  const double x = between([&](std::size_t f) { return across(f); }, rows, from.y, from.x, size.x);
  return {x, between([&](std::size_t f) { return down(f); }, columns, x, from.y, size.y)};
}

std::vector<Warped> warpedOf(const FrameScene& scene, const Method& method) {
  const auto frame = scene.frame(method);
  const shared::Plan plan = frame->downloadPlan();
  const WarpTables tables = frame->downloadWarp();
  const bool each = method.stages->warp == Warp::nonOrthogonal;
  // A view's behind another's.
  const auto ofView = [&](const std::vector<glm::vec2>& all, std::uint32_t view) {
    return std::span(all).subspan(all.size() / plan.viewCount * view, all.size() / plan.viewCount);
  };
  std::vector<Warped> warps;
  for (std::uint32_t view = 0; view < plan.viewCount; ++view) {
    const glm::uvec2 size = plan.views[view].rectSize;
    const auto centres = ofView(tables.centres, view);
    Warped warped{.size = size,
                  .empty = plan.views[view].empty != 0,
                  .rows = each ? size.y : 1,
                  .columns = each ? size.x : 1,
                  .values = {},
                  .centres = {centres.begin(), centres.end()},
                  .samples = {}};
    for (const glm::vec2& knot : ofView(tables.functions, view)) warped.values.push_back(knot.x);
    warps.push_back(std::move(warped));
  }
  takeSamples(warps, scene, plan);
  return warps;
}

std::vector<double> countsBefore(const Warped& warped) {
  return counts(warped, [](const dvec2& sample) { return sample; });
}
std::vector<double> countsAfter(const Warped& warped) { return counts(warped, warped); }

double variation(const std::vector<double>& counts) {
  double sum = 0, squares = 0;
  for (const double c : counts) sum += c, squares += c * c;
  const double mean = sum / double(counts.size());
  return std::sqrt(squares / double(counts.size()) - mean * mean) / mean;
}

}  // namespace sundial::bench
