#include "shadow/receivers.h"

#include <algorithm>
#include <cmath>

namespace sundial {

namespace {

using glm::dvec3;
using glm::dvec4;

// A sample's normal is off by a few roundings of its triangle's edges, more where those are nearly parallel;
// its position, which decides whether it faces a near light, by less than this share of its distance wherever
// the plane is seen at no lesser angle (samples.frag).
constexpr double kRounding = 1e-6, kLeastCosine = 1e-4;

// Vertices are snapped to 1/256 of a pixel when they are drawn: a triangle this high keeps its orientation.
constexpr double kLeastPixels = 1.0 / 16;

// A plane seen from somewhere.
enum class Side { front, back, unclear };

Side sideOf(double height, double distance, double leastCosine) {
  if (height > leastCosine * distance) return Side::front;
  return height < -leastCosine * distance ? Side::back : Side::unclear;
}

double farthest(const PlacedTriangle& t, const dvec3& from) {
  return std::max({glm::distance(t[0], from), glm::distance(t[1], from), glm::distance(t[2], from)});
}

}  // namespace

Onlookers::Onlookers(const shared::FrameConstants& c)
    : eye_(c.wsEye),
      light_(c.lightKind == shared::kLightDirectional ? dvec4(-dvec3(c.wsLightDirection), 0)
                                                      : dvec4(dvec3(c.wsLightPosition), 1)),
      pixelWidth_(std::max(glm::length(c.wsRayPerPixelX), glm::length(c.wsRayPerPixelY))) {}

bool Onlookers::mayBeLit(const PlacedTriangle& t, bool doubleSided, double stretch) const {
  const dvec3 ab = t[1] - t[0], ac = t[2] - t[0], crossed = glm::cross(ab, ac);
  const double area = glm::length(crossed), sine = area / (glm::length(ab) * glm::length(ac));
  if (!(sine > 0)) return true;
  const double leastCosine = kLeastCosine + kRounding * stretch / sine;

  const dvec3 normal = crossed / area;
  const double eyeDistance = farthest(t, eye_), eyeHeight = glm::dot(normal, eye_ - t[0]);
  const Side eye = sideOf(eyeHeight, eyeDistance, leastCosine);
  if (eye == Side::unclear) return true;
  const Side light = light_.w == 0 ? sideOf(glm::dot(normal, dvec3(light_)), 1, leastCosine)
                                   : sideOf(glm::dot(normal, dvec3(light_) - t[0]),
                                            farthest(t, dvec3(light_)) + eyeDistance, leastCosine);
  if (light != Side::unclear && light != eye) return false;
  if (doubleSided || eye == Side::front) return true;
  // Seen from behind it isn't drawn, if it is large enough in the picture not to be turned by rounding.
  const double longest = std::max({glm::length(ab), glm::length(ac), glm::distance(t[1], t[2])});
  const double pixelsHigh = area / longest * (-eyeHeight / eyeDistance) / (eyeDistance * pixelWidth_);
  return pixelsHigh < kLeastPixels;
}

double stretchOf(const glm::dmat4& worldFromMesh) {
  const glm::dmat3 m(worldFromMesh);
  const glm::dmat3 back = glm::inverse(m);
  double forth = 0, home = 0;
  for (int column = 0; column < 3; ++column) {
    forth += glm::dot(m[column], m[column]);
    home += glm::dot(back[column], back[column]);
  }
  return std::sqrt(forth * home);
}

}  // namespace sundial
