// What a built-in scene is: a row in the registry, made of parameters with ranges.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "result.h"
#include "scene/scene_builder.h"

namespace sundial::builtin {

// An integer parameter.
struct Parameter {
  std::string_view name;
  std::uint64_t low, high, fallback;
  std::string_view description;
};

// Values in the order of the row's parameters.
using Values = std::vector<std::uint64_t>;

struct Row {
  std::string_view name, description;
  std::span<const Parameter> parameters;
  void (*make)(SceneBuilder&, const Values&);
};

extern const Row kAtrium, kObservatory, kConference, kTrees, kVillage, kCity, kKnot, kGrid;

// Pieces that several scenes share.
std::uint32_t addColour(SceneBuilder&, std::string name, const glm::vec3& linear, bool doubleSided = false);
// Light from `azimuth` turns (0: from +x, 1/4: from +z) and `elevation` degrees above the horizon.
NamedLight sun(std::string name, double elevationDegrees, double azimuthTurns);
NamedLight spot(std::string name, const glm::dvec3& from, const glm::dvec3& to, double coneDegrees);
NamedView view(std::string name, const glm::dvec3& eye, const glm::dvec3& target, double fovDegrees);

}  // namespace sundial::builtin
