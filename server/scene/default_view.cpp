// Where to look from, and what light to use, when nobody says.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "scene/scene.h"

namespace sundial {

namespace {

// Calls `each` with the corners of every cluster's box, in the world.
template <class Function>
void eachCorner(const Scene& scene, Function each) {
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::uint32_t i = mesh.firstCluster; i < mesh.firstCluster + mesh.clusterCount; ++i)
      for (int corner = 0; corner < 8; ++corner) {
        const glm::bvec3 high(corner & 1, corner & 2, corner & 4);
        each(glm::dvec3(
            instance.worldFromMesh *
            glm::dvec4(glm::mix(scene.clusters[i].boundsMin, scene.clusters[i].boundsMax, high), 1)));
      }
  }
}

// Where a camera stands on one axis across the picture, and how far back it must, so that every point p is
// inside: |across(p) - place| <= tangent (distance - back(p)).
struct Fit {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double across, double back, double tangent) {
    low = std::min(low, across - tangent * back);
    high = std::max(high, across + tangent * back);
  }
  double place() const { return (low + high) / 2; }
  double distance(double tangent) const { return (high - low) / (2 * tangent); }
};

}  // namespace

// Looks down from the corner of the largest coordinates, from as near as shows all that the scene holds in a
// square image, with a margin of 5 %.
View defaultView(const Scene& scene) {
  View view;
  view.verticalFovDegrees = 50;
  view.target = scene.bounds.centre();
  const glm::dvec3 backward = glm::normalize(glm::dvec3(1, 0.8, 1));
  const glm::dvec3 right = glm::normalize(glm::cross(view.up, backward));
  const glm::dvec3 up = glm::cross(backward, right);
  const double tangent = std::tan(glm::radians(view.verticalFovDegrees / 2)) / 1.05;
  Fit across, upwards;
  eachCorner(scene, [&](const glm::dvec3& world) {
    const glm::dvec3 p = world - view.target;
    across.add(glm::dot(p, right), glm::dot(p, backward), tangent);
    upwards.add(glm::dot(p, up), glm::dot(p, backward), tangent);
  });
  const double distance = std::max(across.distance(tangent), upwards.distance(tangent));
  // Nothing, or a point.
  if (!(distance > 0)) {
    view.eye = view.target + backward;
    return view;
  }
  view.target += across.place() * right + upwards.place() * up;
  view.eye = view.target + distance * backward;
  return view;
}

// From the side as the default view sees it, so that shadows show.
Light defaultLight(const Scene&) {
  const double elevation = glm::radians(50.0), azimuth = glm::radians(120.0);
  Light light;
  light.kind = LightKind::directional;
  light.direction = -glm::dvec3(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                                std::cos(elevation) * std::sin(azimuth));
  return light;
}

}  // namespace sundial
