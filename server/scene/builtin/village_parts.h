// The pieces that the village is built from. Each stands on the origin, y up, metres, its front towards +z.
// What stands on sloping ground has foundations below y = 0.
#pragma once

#include "scene/builtin/facade.h"

namespace sundial::builtin {

struct House {
  double width, depth;  // of its walls, along x and z
  unsigned storeys;     // below the roof
  double rise;          // of the roof
  bool isTimbered;      // with beams in its walls
  bool hasShed;         // against its right side
  WallPaints paints;
  glm::vec3 tiles;
};
Shape house(const House&, Random&);

// A nave along x with a tower before its +x end, 30 m long and as high.
Shape church(Random&);

// A well under a small roof, with a crank and a bucket.
Shape well(Random&);

// What the colours of wood, stone and iron are in the village.
constexpr glm::vec3 kWood{0.13f, 0.075f, 0.04f}, kStone{0.34f, 0.31f, 0.27f}, kIron{0.05f, 0.05f, 0.055f};

}  // namespace sundial::builtin
