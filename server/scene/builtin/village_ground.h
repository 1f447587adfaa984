// The ground that the village stands on: terraces that climb towards -z, a level square, lanes. World space,
// metres.
#pragma once

#include "scene/builtin/shapes.h"

namespace sundial::builtin {

constexpr double kVillageHalf = 150;         // the ground reaches this far each way
constexpr glm::dvec2 kVillageSquare{0, -9};  // (x, z) of its middle
constexpr double kSquareRadius = 24;

double villageHeight(double x, double z);
glm::dvec3 onVillageGround(double x, double z, double above = 0);

// Where on a terrace something lies: `along` 0 at the terrace's lower edge, 0.74 at the foot of the bank to
// the next. Terraces -4 to 3 are inside the ground.
glm::dvec3 onTerrace(int terrace, double along, double x, double above = 0);
constexpr double kLaneAlong = 0.13;  // where each terrace's lane runs

Shape villageGround();

}  // namespace sundial::builtin
