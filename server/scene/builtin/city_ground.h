// The city's plan, and what lies flat on it. The avenue runs along z through the origin; beside it stand
// columns of blocks, between them streets. World space, metres.
#pragma once

#include "scene/builtin/shapes.h"

namespace sundial::builtin {

constexpr int kColumns = 3, kRows = 13;                  // blocks: columns on each side of the avenue
constexpr double kPitchX = 86, kPitchZ = 70;             // from block to block
constexpr glm::dvec2 kBlock{33, 25};                     // half a block, between its outer walls
constexpr double kPavement = 4, kKerb = 0.14;            // width, height
constexpr double kFirst = 53;                            // x of the first column's middle
constexpr double kRoad = kFirst - kBlock.x - kPavement;  // half the avenue's carriageway
constexpr double kHalfX = 300, kHalfZ = 510;             // the ground reaches this far each way

// The ground, with the avenue's broken lines.
Shape cityRoad();
// Of one block, around its middle; y = 0 is where one walks.
Shape cityPavement();
// Four lawns with paths between them, as large as a block.
Shape cityLawn();

}  // namespace sundial::builtin
