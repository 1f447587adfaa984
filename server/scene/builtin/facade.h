// Walls with windows and roofs, as the houses of a village and of a city have them. Metres. A wall lies in
// the plane z = 0 and is seen from +z, x to the right, y up; what stands out of it has z > 0.
#pragma once

#include "scene/builtin/random.h"
#include "scene/builtin/shapes.h"

namespace sundial::builtin {

// Linear RGB.
struct WallPaints {
  glm::vec3 wall, trim, glass;
};

// A part of the wall: what belongs to one window.
struct Bay {
  glm::dvec2 min, max;
};

struct Window {
  double width, height, sill;   // sill: from the bay's foot to the opening's
  double recess = 0.15;         // how deep the pane lies behind the wall
  unsigned across = 1, up = 1;  // panes, with bars between them
  double ledge = 0;             // how far the window sill stands out; 0: there is none
  double shutters = 0;          // width of each of two shutters beside it; 0: there are none
};

// The wall of the bay around the window, its reveals, pane, bars, sill and shutters. The window fits into the
// bay, in the middle of its width.
void addWindow(Shape&, const Bay&, const Window&, const WallPaints&);

// A wall of width x height with a window in each of columns x rows equal bays.
Shape wallOfWindows(const glm::dvec2& size, unsigned columns, unsigned rows, const Window&,
                    const WallPaints&);

// A railing along x, centred: two rails and bars between.
Shape railing(double width, double height, unsigned bars);

// A tiled roof of two slopes that meet in a ridge along x, centred over the origin; its walls end at y = 0.
struct GableRoof {
  double length, span;    // of the walls below, along x and z
  double rise;            // from the walls' end to the ridge
  double overhang = 0.4;  // beyond the walls, each way
  double tile = 0.8;      // side of a tile, about
};
Shape gableRoof(const GableRoof&, const glm::vec3& tiles, const glm::vec3& wood, Random&);

// Calls place(width of the side, transform) for the four walls of a rectangle width x depth around the y
// axis, in the order +z, +x, -z, -x.
template <class Place>
void eachSide(double width, double depth, Place place) {
  const glm::dvec3 front(-width / 2, 0, depth / 2), side(-depth / 2, 0, width / 2);
  place(width, translation(front));
  place(depth, turnedY(0.25) * translation(side));
  place(width, turnedY(0.5) * translation(front));
  place(depth, turnedY(0.75) * translation(side));
}

}  // namespace sundial::builtin
