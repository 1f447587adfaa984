#include "measure/reference_edges.h"

#include <algorithm>
#include <cmath>

#include "shared/scene.h"

namespace sundial {

namespace {

// Whether two neighbouring pixels show one continuous surface. Either the depths differ by no more than a
// surface inclined ten to one shows across a pixel; or, for floors that run to the horizon, each sample lies
// in the other's plane to within a pixel. Both planes are asked: at a silhouette the nearer surface is seen
// edge-on and its plane may well contain what is behind it.
class Continuity {
 public:
  explicit Continuity(const MeasureInput& input) : samples_(input.samples), depth_(input.viewDepth) {
    // A pixel's extent at a depth of 1, for a field of view of about a radian; small images are no excuse for
    // calling everything continuous.
    pixel_ = std::min(1.0f / static_cast<float>(input.size.y), kLargestStep / kInclination);
  }

  bool operator()(std::size_t a, std::size_t b) const {
    const float nearer = std::min(depth_[a], depth_[b]);
    if (std::abs(depth_[a] - depth_[b]) <= kInclination * pixel_ * nearer) return true;
    const glm::vec3 between = samples_[b].wsPosition - samples_[a].wsPosition;
    return std::max(std::abs(glm::dot(samples_[a].wsNormal, between)),
                    std::abs(glm::dot(samples_[b].wsNormal, between))) <= pixel_ * nearer;
  }

 private:
  static constexpr float kInclination = 10;
  static constexpr float kLargestStep = 0.05f;  // of the depth

  std::span<const shared::ViewSample> samples_;
  std::span<const float> depth_;
  float pixel_;
};

}  // namespace

std::vector<std::uint8_t> referenceEdges(const MeasureInput& input) {
  const std::size_t width = input.size.x, n = input.samples.size();
  const Continuity continuous(input);
  std::vector<std::uint8_t> edge(n, 0);
  const auto lit = [&](std::size_t i) { return input.reference[i] >= 0.5f; };
  const auto visible = [&](std::size_t i) { return input.samples[i].instance != shared::kNoInstance; };
  const auto markEdgeBetween = [&](std::size_t a, std::size_t b) {
    if (lit(a) != lit(b) && visible(a) && visible(b) && continuous(a, b)) edge[a] = edge[b] = 1;
  };
  for (std::size_t first = 0; first < n; first += width)
    for (std::size_t i = first; i < first + width; ++i) {
      if (i + 1 < first + width) markEdgeBetween(i, i + 1);
      if (i + width < n) markEdgeBetween(i, i + width);
    }
  return edge;
}

}  // namespace sundial
