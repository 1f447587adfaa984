// The pieces that the atrium is built from. Each stands on the origin, y up, metres.
#pragma once

#include "scene/builtin/random.h"
#include "scene/builtin/shapes.h"

namespace sundial::builtin {

// A fluted column with base and capital, `height` in all.
Shape column(double height, double radius, unsigned flutes);

// The wall between two columns `width` apart, from y = 0 (the springing) to `height`, `thickness` deep, with
// a round arch of `radius` cut out and moulding around it.
struct ArchSize {
  double width, height, thickness, radius;
};
Shape archBay(const ArchSize&);

// A balustrade along x, centred, with turned balusters.
Shape balustrade(double width, unsigned balusters);

// A curtain in the (x, y) plane, hanging from y = 0 by its top, with folds.
Shape curtain(double width, double height, Random&);

// A lamp on a chain of links, hanging from y = 0: metal, then glass.
struct Lamp {
  Shape metal, glass;
};
Lamp hangingLamp(unsigned links);

// A potted plant: pot, then leaf cards.
struct Plant {
  Shape pot, leaves;
};
Plant plant(unsigned leaves, Random&);

// A moulding swept around the inside of a rectangle of half-sizes (x, z), mitred at its corners. The profile
// is (distance into the rectangle, height), upwards.
Shape cornice(const glm::dvec2& half, std::span<const glm::dvec2> profile);

}  // namespace sundial::builtin
