// Trees, each standing on the origin, y up, metres.
#pragma once

#include "scene/builtin/random.h"
#include "scene/builtin/shapes.h"

namespace sundial::builtin {

struct Tree {
  Shape wood, leaves;
};

// A trunk, 5 to 7 m high, that forks into boughs, each with twigs' cards around its outer half.
struct Broadleaf {
  int boughs = 13, cards = 28;  // cards a bough; boughs at least 2
  double card = 1;              // a card's length, about
};
Tree broadleaf(const Broadleaf&, Random&);

// Whorls of drooping fronds up a straight trunk, 9 to 12 m high.
Tree conifer(Random&);

}  // namespace sundial::builtin
