// Where one looks from and what lights the scene, in world space and double precision.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace sundial {

// A pinhole camera. Metres; the image's width follows from its aspect ratio.
struct View {
  glm::dvec3 eye{0};
  glm::dvec3 target{0, 0, -1};
  glm::dvec3 up{0, 1, 0};
  double verticalFovDegrees = 50;  // (0, 180)
};

enum class LightKind { directional, spot, point };

struct Light {
  LightKind kind = LightKind::directional;
  glm::dvec3 direction{0, -1, 0};  // in which light travels, unit (directional and spot: the axis)
  glm::dvec3 position{0};          // spot, point
  double coneDegrees = 60;         // spot: full angle of the cone, (0, 170]
};

struct NamedView {
  std::string name;
  View view;
};

struct NamedLight {
  std::string name;
  Light light;
};

// A camera path: one view a key frame, in between interpolated; played at `frames` evenly spaced times.
struct NamedPath {
  std::string name;
  std::vector<View> keys;
  unsigned frames = 0;
};

// The same for a light; all keys are of one kind.
struct NamedLightPath {
  std::string name;
  std::vector<Light> keys;
  unsigned frames = 0;
};

}  // namespace sundial
