#include "scene/builtin/city_ground.h"

#include <algorithm>
#include <array>

namespace sundial::builtin {

Shape cityRoad() {
  constexpr glm::vec3 kAsphalt{0.085f, 0.085f, 0.09f}, kLine{0.5f, 0.5f, 0.48f};
  Shape road;
  const auto strip = [&](double x0, double x1, double z0, double z1, const glm::vec3& colour) {
    road.paint(colour);
    road.quad({x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}, {x0, 0, z0});
  };
  // Beside the avenue in pieces of about 40 m, for clusters that are not much larger than that.
  constexpr int kAcross = 7, kAlong = 24;
  for (const double side : {-1.0, 1.0})
    for (int i = 0; i < kAcross; ++i)
      for (int j = 0; j < kAlong; ++j) {
        const double a = side * glm::mix(kRoad, kHalfX, static_cast<double>(i) / kAcross);
        const double b = side * glm::mix(kRoad, kHalfX, (i + 1.0) / kAcross);
        const double z = kHalfZ * (2.0 * j / kAlong - 1);
        strip(std::min(a, b), std::max(a, b), z, z + 2 * kHalfZ / kAlong, kAsphalt);
      }
  // The avenue: on each side of the middle a line between two lanes, dashes and gaps of one length.
  constexpr int kDashes = 256;
  constexpr double kLane = 9, kHalfWidth = 0.09, kDash = 2 * kHalfZ / kDashes;
  constexpr std::array<double, 6> kCuts{
      -kRoad, -kLane - kHalfWidth, -kLane + kHalfWidth, kLane - kHalfWidth, kLane + kHalfWidth, kRoad};
  for (int j = 0; j < kDashes; ++j)
    for (std::size_t i = 0; i + 1 < kCuts.size(); ++i) {
      const double z = -kHalfZ + kDash * j;
      strip(kCuts[i], kCuts[i + 1], z, z + kDash, i % 2 == 1 && j % 2 == 0 ? kLine : kAsphalt);
    }
  return road;
}

Shape cityPavement() {
  const glm::dvec2 half = kBlock + kPavement;
  Shape slab;
  slab.paint({0.3f, 0.29f, 0.27f});
  slab.box({-half.x, -kKerb - 0.06, -half.y}, {half.x, 0, half.y});
  return slab;
}

Shape cityLawn() {
  constexpr double kPath = 2;
  Shape lawn;
  lawn.paint({0.13f, 0.2f, 0.06f});
  for (const double x : {-1.0, 1.0})
    for (const double z : {-1.0, 1.0}) {
      const glm::dvec2 a(x * kPath, z * kPath), b(x * kBlock.x, z * kBlock.y);
      const glm::dvec2 min = glm::min(a, b), max = glm::max(a, b);
      lawn.box({min.x, 0, min.y}, {max.x, 0.12, max.y});
    }
  return lawn;
}

}  // namespace sundial::builtin
