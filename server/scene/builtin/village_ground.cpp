#include "scene/builtin/village_ground.h"

#include <cmath>

#include "scene/builtin/random.h"

namespace sundial::builtin {

namespace {

constexpr double kPitch = 34, kStep = 3.4, kFlat = 0.74;  // of a terrace: depth, rise, share that is level
constexpr unsigned kCells = 110;                          // each way

double smooth(double t) {
  const double s = glm::clamp(t, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

// Terraces bend with the hill.
double bend(double x) { return 6 * sinTurns(x / 150 + 0.1); }
double terraceOf(double x, double z) { return (bend(x) - z) / kPitch; }

double hillside(double x, double z) {
  const double s = terraceOf(x, z), below = std::floor(s);
  return kStep * (below + smooth((s - below - kFlat) / (1 - kFlat))) +
         0.25 * sinTurns((x + 2 * z) / 67) * cosTurns(x / 41);
}

double squareDistance(double x, double z) { return glm::distance(glm::dvec2(x, z), kVillageSquare); }

// The path that climbs through all terraces.
double pathDistance(double x, double z) { return std::abs(x - 9 * sinTurns((z - kVillageSquare.y) / 130)); }

// 1 on what feet keep bare.
double bareness(double x, double z) {
  const double s = terraceOf(x, z), lane = std::abs(s - std::floor(s) - kLaneAlong) * kPitch;
  const double worn = std::min(lane, pathDistance(x, z)) - 1.5;
  return 1 - smooth(std::min(worn / 1.6, (squareDistance(x, z) - kSquareRadius + 4) / 4));
}

}  // namespace

double villageHeight(double x, double z) {
  const double square = hillside(kVillageSquare.x, kVillageSquare.y);
  const double isSquare = 1 - smooth((squareDistance(x, z) - kSquareRadius) / 14);
  return glm::mix(hillside(x, z), square, isSquare);
}

glm::dvec3 onVillageGround(double x, double z, double above) { return {x, villageHeight(x, z) + above, z}; }

glm::dvec3 onTerrace(int terrace, double along, double x, double above) {
  return onVillageGround(x, bend(x) - kPitch * (terrace + along), above);
}

Shape villageGround() {
  constexpr glm::vec3 kGrass{0.15f, 0.22f, 0.07f}, kMeadow{0.26f, 0.27f, 0.1f}, kEarth{0.36f, 0.28f, 0.18f};
  Shape ground;
  ground.surface(kCells, kCells, [&](double u, double v) {
    const double x = kVillageHalf * (2 * u - 1), z = kVillageHalf * (1 - 2 * v);
    const double patch = 0.5 + 0.5 * sinTurns(x / 23 + 0.3 * sinTurns(z / 31)) * cosTurns(z / 19);
    const double bare = bareness(x, z);
    ground.paint(
        glm::mix(glm::mix(kGrass, kMeadow, static_cast<float>(patch)), kEarth, static_cast<float>(bare)));
    return glm::dvec3(x, villageHeight(x, z) - 0.1 * bare, z);
  });
  return ground;
}

}  // namespace sundial::builtin
