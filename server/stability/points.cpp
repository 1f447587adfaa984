#include "stability/points.h"

#include <algorithm>
#include <cmath>

namespace sundial {

namespace {

// The finaliser of SplitMix64.
std::uint64_t hashed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// In (0, 1).
double unit(std::uint64_t hash) { return (static_cast<double>(hash >> 11) + 0.5) * 0x1p-53; }

// A material of a triangle is its cluster's; clusters lie in the order of their triangles.
bool isOneSided(const Scene& scene, std::uint32_t triangle) {
  const auto after = std::ranges::upper_bound(scene.clusters, 3 * triangle, {}, &shared::Cluster::firstIndex);
  return !scene.materials[std::prev(after)->material].doubleSided;
}

bool isInImage(const glm::vec4& clip, float nearDistance) {
  return clip.w > nearDistance && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w;
}

glm::vec4 clipOf(const shared::ViewSample& sample, const shared::FrameConstants& constants) {
  return constants.clipFromWorld * glm::vec4(sample.wsPosition, 1);
}

}  // namespace

void PointChooser::add(unsigned frame, std::span<const shared::ViewSample> samples,
                       const shared::FrameConstants& constants, const glm::dvec3& origin) {
  const double pixelArea = static_cast<double>(glm::length(constants.wsRayPerPixelX)) *
                           static_cast<double>(glm::length(constants.wsRayPerPixelY));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const shared::ViewSample& sample = samples[i];
    if (sample.instance == shared::kNoInstance) continue;
    // The pixel's area at depth 1, carried to the surface along the pixel's ray.
    const double depth = clipOf(sample, constants).w;
    const double facing = std::abs(glm::dot(sample.wsNormal, sample.wsPosition - constants.wsEye));
    const double area = pixelArea * depth * depth * depth / facing;
    if (!(area > 0) || !std::isfinite(area)) continue;

    const std::uint64_t order = std::uint64_t{frame} << 32 | i;
    const double key = -std::log(unit(hashed(hashed(seed_) ^ order))) / area;
    if (candidates_.size() == count_) {
      if (!(key < candidates_.top().key)) continue;
      candidates_.pop();
    }
    candidates_.push({key,
                      order,
                      {.position = glm::dvec3(sample.wsPosition) + origin,
                       .normal = sample.wsNormal,
                       .instance = sample.instance,
                       .triangle = sample.triangle}});
  }
}

std::vector<SurfacePoint> PointChooser::take(const Scene& scene) {
  std::vector<Candidate> chosen;
  for (; !candidates_.empty(); candidates_.pop()) chosen.push_back(candidates_.top());
  std::ranges::sort(chosen, {}, &Candidate::order);
  std::vector<SurfacePoint> points;
  for (Candidate& candidate : chosen) {
    candidate.point.oneSided = isOneSided(scene, candidate.point.triangle);
    points.push_back(candidate.point);
  }
  return points;
}

PointsInFrame look(std::span<const SurfacePoint> points, const Reference& reference, const View& view,
                   const Light& light, const glm::dvec3& origin, const shared::FrameConstants& constants) {
  PointsInFrame out{.samples = std::vector<shared::ViewSample>(points.size()),
                    .states = std::vector<PointState>(points.size())};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint& point = points[i];
    const bool isBack = glm::dot(glm::dvec3(point.normal), view.eye - point.position) < 0;
    shared::ViewSample& sample = out.samples[i];
    sample.wsPosition = point.position - origin;
    sample.wsNormal = isBack ? -point.normal : point.normal;
    sample.instance = isBack && point.oneSided ? shared::kNoInstance : point.instance;
    sample.triangle = point.triangle;
    if (isBack) out.states[i] |= kPointBack;
  }

  // What a lamp in the camera would light is what the camera sees.
  const Light lamp{.kind = LightKind::point, .position = view.eye};
  std::vector<float> traced(points.size());
  reference.trace(out.samples, lamp, origin, traced);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (traced[i] > 0 && isInImage(clipOf(out.samples[i], constants), constants.nearDistance))
      out.states[i] |= kPointSeen;

  reference.trace(out.samples, light, origin, traced);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (traced[i] >= 0.5f) out.states[i] |= kPointTruthLit;
  return out;
}

glm::vec2 pixelOf(const shared::ViewSample& sample, const shared::FrameConstants& constants) {
  const glm::vec4 clip = clipOf(sample, constants);
  return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(constants.imageSize);
}

}  // namespace sundial
