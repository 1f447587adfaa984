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

// `at` pixels beside a sample, on the plane of its surface; the sample where that plane is seen edge-on.
dvec3 besideSample(const shared::ViewSample& sample, const shared::FrameConstants& c, const dvec2& at) {
  const dvec3 eye(c.wsEye), to = dvec3(sample.wsPosition) - eye, normal(sample.wsNormal);
  const double depth = (glm::dmat4(c.clipFromWorld) * glm::dvec4(dvec3(sample.wsPosition), 1)).w;
  const dvec3 ray = to / depth + at.x * dvec3(c.wsRayPerPixelX) + at.y * dvec3(c.wsRayPerPixelY);
  const double distance = glm::dot(normal, to) / glm::dot(normal, ray);
  return distance > 0.5 * depth && distance < 2 * depth ? eye + distance * ray : eye + to;
}

// Those of pixels that face the light, before any warp: in the plan's only map, or each in its face's.
void takeSamples(std::vector<Warped>& warps, const FrameScene& scene, const shared::Plan& plan,
                 unsigned side) {
  const shared::FrameConstants constants = scene.constants();
  const std::vector<shared::ViewSample> samples = scene.samples();
  const std::vector<std::uint8_t> faces = scene.facing();
  const glm::dmat4 lightFromWorld(plan.lightFromWorld);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!faces[i]) continue;
    for (unsigned part = 0; part < side * side; ++part) {
      const dvec2 at = (dvec2(part % side, part / side) + 0.5) / double(side) - 0.5;
      const dvec3 ws = side == 1 ? dvec3(samples[i].wsPosition) : besideSample(samples[i], constants, at);
      const glm::vec4 light(lightFromWorld * glm::dvec4(ws, 1));
      const std::uint32_t view = warps.size() == shared::kCubeFaces ? shared::faceOf(light) : 0;
      const glm::dvec4 ls(shared::faceFromLight(view, light));
      const dvec2 low(plan.views[view].lsMin), high(plan.views[view].lsMax);
      const dvec2 share = glm::clamp((dvec2(ls) / ls.w - low) / (high - low), 0.0, 1.0);
      warps[view].samples.push_back(dvec2(share.x, 1 - share.y) * dvec2(warps[view].size));  // rows run down
    }
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

std::vector<Warped> warpedOf(const FrameScene& scene, const Method& method, unsigned side) {
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
  takeSamples(warps, scene, plan, side);
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
