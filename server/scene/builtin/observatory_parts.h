// The pieces that the observatory is built from. Each stands on the origin, y up, metres.
#pragma once

#include <array>

#include "scene/builtin/random.h"
#include "scene/builtin/shapes.h"

namespace sundial::builtin {

// Half a sphere with a slit from its foot to a little beyond its top, along +x.
struct DomeSize {
  double radius;
  double slit;  // half its width
};
Shape domeShell(const DomeSize&);  // seen from both sides
// Ribs up to the top or to the slit, rings around, and the slit's frame.
Shape domeRibs(const DomeSize&);

// A slab between two circles, one of `count` around; its top is at y = 0.
Shape floorTile(double inner, double outer, int count);

// Stairs that wind once around an axis, with a newel and a handrail.
Shape windingStairs(double height, int steps);

// A refractor on an equatorial mount.
struct Telescope {
  Shape pier, mount, tube, brass;
};
Telescope makeTelescope();

// Against a wall behind it (+z), shelves open to -z.
struct Bookcase {
  Shape wood;
  std::array<Shape, 3> books;
};
Bookcase bookcase(double width, double height, int shelves, Random&);

Shape table(double width, double depth, double height);
Shape lathedStool();

}  // namespace sundial::builtin
