// The buildings of the city. Each stands on the origin, y up, metres, its front towards +z.
#pragma once

#include "scene/builtin/facade.h"

namespace sundial::builtin {

// All houses of a block stand on lots of one size, wall to wall.
constexpr double kLotWidth = 22, kLotDepth = 14;

enum class Roof { flat, mansard };

// Shops below, `storeys` storeys of windows above, in front and behind.
struct Tenement {
  unsigned storeys, bays;  // bays: windows along the front
  Window window;           // of the front
  bool hasBalconies, hasBrackets;
  Roof roof;
  WallPaints paints;
};
// With windows in its side walls if its neighbours are streets.
Shape tenement(const Tenement&, bool isCorner);
double tenementHeight(const Tenement&);  // of its walls

// An office tower of tiers, each narrower than the one below, with a mast.
struct Tier {
  double half;  // of its square plan
  unsigned storeys;
};
Shape tower(std::span<const Tier>, const WallPaints&);

// A market hall on columns with a saw-tooth roof, kLotWidth x kLotDepth.
Shape marketHall();

}  // namespace sundial::builtin
