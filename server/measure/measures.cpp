#include "measure/measures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "measure/distance_transform.h"
#include "measure/distinct_texels.h"
#include "measure/reference_edges.h"
#include "shared/plan.h"
#include "shared/scene.h"

namespace sundial {

namespace {

bool visible(const MeasureInput& in, std::size_t i) { return in.samples[i].instance != shared::kNoInstance; }

bool faces(const MeasureInput& in, std::size_t i) {
  if (!in.facesLight.empty()) return in.facesLight[i] != 0;
  return in.answers.empty() || in.answers[i].facesLight != 0;
}

bool answered(const MeasureInput& in, std::size_t i) {
  return !in.answers.empty() && in.answers[i].view < shared::kMaxShadowViews;
}

// S and R as measures see them that compare light with shadow.
bool lit(float visibility) { return visibility >= 0.5f; }

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

// Nearest rank: the smallest value that at least this share of all values doesn't exceed. Reorders them.
double percentile(std::vector<float>& values, double p) {
  if (values.empty()) return 0;
  const double rank = std::ceil(p * static_cast<double>(values.size()));
  const auto nth = values.begin() + std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(rank), 1) - 1;
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

// Omega, Omega+ and the pixels of Omega+ where S isn't R.
struct Pixels {
  std::size_t visible = 0;
  std::vector<std::uint32_t> facing, wrong;
};

// pixel_match: the share of Omega with S = R.
// false_lit, false_shadow: the shares of Omega+ with S > R, S < R.
// mean_abs_error: the mean of |S - R| over Omega+, neither of them rounded.
Pixels comparePixels(const MeasureInput& in, Measures& out) {
  Pixels pixels;
  std::size_t matching = 0, falseLit = 0;
  double error = 0;
  for (std::uint32_t i = 0; i < in.samples.size(); ++i) {
    if (!visible(in, i)) continue;
    ++pixels.visible;
    const bool s = lit(in.visibility[i]), r = lit(in.reference[i]);
    matching += s == r;
    if (!faces(in, i)) continue;
    pixels.facing.push_back(i);
    error += std::abs(static_cast<double>(in.visibility[i]) - in.reference[i]);
    if (s == r) continue;
    pixels.wrong.push_back(i);
    falseLit += s;
  }
  if (pixels.visible > 0) out.pixelMatch = share(matching, pixels.visible);
  out.falseLit = share(falseLit, pixels.facing.size());
  out.falseShadow = share(pixels.wrong.size() - falseLit, pixels.facing.size());
  if (!pixels.facing.empty()) out.meanAbsError = error / static_cast<double>(pixels.facing.size());
  return pixels;
}

// edge_error_px: p50, p95 and maximum of the distances from wrong pixels to the nearest reference edge.
// interior_error: the share of Omega+ wrong and farther from it than 2 px and than 1.5 footprints of the
// texel that answered.
void measureEdges(const MeasureInput& in, const Pixels& pixels, Measures& out) {
  if (pixels.wrong.empty()) return;
  const std::vector<float> toEdge = distanceTransform(in.size, referenceEdges(in));
  const float diagonal = glm::length(glm::vec2(in.size));
  std::vector<float> distances;
  distances.reserve(pixels.wrong.size());
  std::size_t interior = 0;
  for (const std::uint32_t i : pixels.wrong) {
    const float distance = std::min(toEdge[i], diagonal);
    distances.push_back(distance);
    const float footprint = answered(in, i) ? in.answers[i].footprint : 0;
    interior +=
        distance > 2 && !(distance <= 1.5f * footprint);  // a footprint that is no number excuses nothing
  }
  out.edgeErrorPx = {percentile(distances, 0.5), percentile(distances, 0.95), percentile(distances, 1)};
  out.interiorError = share(interior, pixels.facing.size());
}

// texel_px: p50 and p95 of the answering texels' footprints over Omega+.
// utilisation: texels read by at least one sample of Omega+ (no other reads) over texels allocated.
void measureTexels(const MeasureInput& in, const Pixels& pixels, Measures& out) {
  if (in.answers.empty()) return;
  std::vector<float> footprints;
  footprints.reserve(pixels.facing.size());
  DistinctTexels read;
  for (const std::uint32_t i : pixels.facing) {
    if (!answered(in, i)) continue;
    const shared::Answer& answer = in.answers[i];
    if (!std::isnan(answer.footprint)) footprints.push_back(answer.footprint);
    read.add(answer.view, answer.texel);
  }
  out.texelPx = {percentile(footprints, 0.5), percentile(footprints, 0.95)};
  out.utilisation = share(read.count(), in.storeTexels);
}

}  // namespace

Measures measure(const MeasureInput& in) {
  [[maybe_unused]] const std::size_t n = std::size_t{in.size.x} * in.size.y;
  assert(in.samples.size() == n && in.viewDepth.size() == n && in.visibility.size() == n &&
         in.reference.size() == n && (in.answers.empty() || in.answers.size() == n) &&
         (in.facesLight.empty() || in.facesLight.size() == n));
  Measures out;
  const Pixels pixels = comparePixels(in, out);
  measureEdges(in, pixels, out);
  measureTexels(in, pixels, out);
  return out;
}

}  // namespace sundial
