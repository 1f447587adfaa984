#include "shadow/lit_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shadow/convex_hull.h"
#include "shadow/polygon.h"

namespace sundial {

namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

// Scenes at hand took three to eight.
constexpr int kMostSteps = 16;
// Lines around a spot's cone: together 0.03 % wider than it at their corners.
constexpr int kConeSides = 128;

bool lexicographic(const dvec2& a, const dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

bool isWithin(std::span<const dvec2> hull, std::span<const dvec2> points) {
  return std::ranges::all_of(points, [&](const dvec2& p) { return holds(hull, p); });
}

// A point of light space after division.
struct Projected {
  dvec2 at;
  double z;
};

// What is seen of a cluster's box: `count` points around it, from `first` on.
struct OpenBox {
  std::size_t cluster, first, count;
  double farZ;
};

class OutlineSearch {
 public:
  OutlineSearch(const LitPart& part, const PlacedClusters& clusters)
      : part_(part), clusters_(clusters), lightFromWorld_(part.lightFromWorld) {
    if (std::isfinite(part.coneRadius))
      for (int i = 0; i < kConeSides; ++i) {
        const double angle = 2 * std::numbers::pi * i / kConeSides;
        aroundCone_.emplace_back(std::cos(angle), std::sin(angle));
      }
    for (std::size_t i = 0; i < clusters.boxes().size(); ++i) takeBox(i);
  }

  Outline find() {
    for (int step = 0; step < kMostSteps && replaceOutermost(); ++step) dropInner();
    for (const OpenBox& open : open_) farZ_ = std::min(farZ_, open.farZ);
    return {convexHull(withOpen()), farZ_};
  }

 private:
  Projected projected(const dvec3& corner) const {
    const dvec4 light = lightFromWorld_ * dvec4(corner, 1);
    return {dvec2(light) / light.w, light.z / light.w};
  }

  // The cone is a disc after division.
  bool isInCone(std::span<const dvec2> points) const {
    const double radius = part_.coneRadius;
    return std::ranges::all_of(points, [&](const dvec2& p) { return glm::dot(p, p) <= radius * radius; });
  }

  void clipByCone(std::vector<dvec2>& polygon) const {
    if (isInCone(polygon)) return;
    const double radius = part_.coneRadius;
    for (const dvec2& outwards : aroundCone_) {
      const auto height = [&](const dvec2& p) { return radius - glm::dot(outwards, p); };
      if (std::ranges::any_of(polygon, [&](const dvec2& p) { return height(p) < 0; })) clip(polygon, height);
    }
  }

  void takeBox(std::size_t cluster) {
    OpenBox open{cluster, points_.size(), 0, 1e300};
    std::vector<dvec2> corners;
    eachCornerWithin(clusters_.boxes()[cluster], part_.planes, [&](const dvec3& corner) {
      const auto [at, z] = projected(corner);
      corners.push_back(at);
      open.farZ = std::min(open.farZ, z);
    });
    if (!isInCone(corners)) {
      corners = convexHull(corners);
      clipByCone(corners);
    }
    if (corners.empty()) return;
    open.count = corners.size();
    points_.insert(points_.end(), corners.begin(), corners.end());
    open_.push_back(open);
  }

  std::span<const dvec2> pointsOf(const OpenBox& open) const {
    return std::span(points_).subspan(open.first, open.count);
  }

  std::vector<dvec2> withOpen() const {
    std::vector<dvec2> all = hull_;
    for (const OpenBox& open : open_) {
      const auto points = pointsOf(open);
      all.insert(all.end(), points.begin(), points.end());
    }
    return all;
  }

  // Adds what could be seen lit of a cluster's triangles.
  void takeTriangles(std::size_t index, std::vector<dvec2>& points) {
    const PlacedCluster cluster = clusters_[index];
    const Planes cuts = cutting(clusters_.boxes()[index], part_.planes).value_or(Planes());
    const double stretch = stretchOf(cluster.worldFromMesh);
    std::vector<dvec3> seen;
    std::vector<dvec2> corners;
    for (std::size_t i = 0; i < cluster.triangles(); ++i) {
      const PlacedTriangle triangle = cluster.triangle(i);
      if (!part_.onlookers.mayBeLit(triangle, cluster.doubleSided, stretch)) continue;
      seen.assign(triangle.begin(), triangle.end());
      for (const dvec4& plane : cuts)
        clip(seen, [&](const dvec3& p) { return glm::dot(plane, dvec4(p, 1)); });
      corners.clear();
      for (const dvec3& corner : seen) {
        const auto [at, z] = projected(corner);
        corners.push_back(at);
        farZ_ = std::min(farZ_, z);
      }
      if (isWithin(hull_, corners)) continue;
      clipByCone(corners);
      points.insert(points.end(), corners.begin(), corners.end());
    }
  }

  // Puts triangles in the place of the boxes that are corners of the hull; whether there were any.
  bool replaceOutermost() {
    std::vector<dvec2> outer = convexHull(withOpen());
    std::ranges::sort(outer, lexicographic);
    const auto isCorner = [&](const dvec2& p) { return std::ranges::binary_search(outer, p, lexicographic); };
    std::vector<dvec2> points = hull_;
    const std::size_t replaced = std::erase_if(open_, [&](const OpenBox& open) {
      const bool outermost = std::ranges::any_of(pointsOf(open), isCorner);
      if (outermost) takeTriangles(open.cluster, points);
      return outermost;
    });
    hull_ = convexHull(points);
    return replaced > 0;
  }

  // What lies in the hull of triangles stays there whatever becomes of other boxes.
  void dropInner() {
    std::erase_if(open_, [&](const OpenBox& open) {
      const bool inner = isWithin(hull_, pointsOf(open));
      if (inner) farZ_ = std::min(farZ_, open.farZ);
      return inner;
    });
  }

  const LitPart& part_;
  const PlacedClusters& clusters_;
  const glm::dmat4 lightFromWorld_;
  std::vector<dvec2> aroundCone_;  // directions
  std::vector<dvec2> points_;      // of boxes
  std::vector<OpenBox> open_;      // boxes that could still be corners
  std::vector<dvec2> hull_;        // of triangles
  double farZ_ = 1e300;            // of what isn't open
};

}  // namespace

Outline litOutline(const LitPart& part, const PlacedClusters& clusters) {
  return OutlineSearch(part, clusters).find();
}

}  // namespace sundial
