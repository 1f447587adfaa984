#include "bench/warped_samples.h"

#include <algorithm>
#include <cmath>

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

// In the plan's only map, before any warp.
std::vector<dvec2> samplesIn(const FrameScene& scene, const shared::Plan& plan) {
  const std::vector<shared::ViewSample> samples = scene.samples();
  const std::vector<std::uint8_t> faces = scene.facing();
  const shared::ShadowView& view = plan.views[0];
  const dvec2 low(view.lsMin), high(view.lsMax);
  std::vector<dvec2> out;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!faces[i]) continue;
    const glm::dvec4 ls = glm::dmat4(plan.lightFromWorld) * glm::dvec4(dvec3(samples[i].wsPosition), 1);
    const dvec2 share = (dvec2(ls) / ls.w - low) / (high - low);
    out.push_back(dvec2(share.x, 1 - share.y) * dvec2(view.rectSize));  // rows run down
  }
  return out;
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
  if (rows == 1) return {tables[2 * x], tables[2 * (size.x + y)]};
  const float* at = &tables[2 * (std::size_t{y} * size.x + x)];
  return {at[0], at[1]};
}

dvec2 Warped::operator()(const dvec2& from) const {
  const double x = between([&](std::size_t f) { return across(f); }, rows, from.y, from.x, size.x);
  return {x, between([&](std::size_t f) { return down(f); }, columns, x, from.y, size.y)};
}

Warped warpedOf(const FrameScene& scene, const Method& method) {
  const auto frame = scene.frame(method);
  const shared::Plan plan = frame->downloadPlan();
  const glm::uvec2 size = plan.views[0].rectSize;
  const bool each = method.stages->warp == Warp::nonOrthogonal;
  Warped out{.size = size,
             .rows = each ? size.y : 1,
             .columns = each ? size.x : 1,
             .tables = frame->downloadWarp(),
             .values = {},
             .samples = samplesIn(scene, plan)};
  const std::size_t centres = each ? std::size_t{size.x} * size.y : std::size_t{size.x} + size.y;
  for (std::size_t i = 2 * centres; i < out.tables.size(); i += 2) out.values.push_back(out.tables[i]);
  return out;
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
