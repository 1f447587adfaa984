// The pieces that the conference room is built from. Each stands on the origin, y up, metres.
#pragma once

#include "scene/builtin/random.h"
#include "scene/builtin/shapes.h"

namespace sundial::builtin {

// An office chair that looks along -z: five castors, a lift, a shell with arms.
struct Chair {
  Shape metal, cloth;
};
Chair officeChair();

// A long table along x with rounded ends and a slot along its middle, on three feet.
struct LongTable {
  Shape top, feet;
};
LongTable longTable(double length, double width, double height);

// Curved slats between two cords, hanging from y = 0 in the (x, y) plane.
Shape blind(double width, double height, int slats);

// What stands on a table: laptop (open towards +z), carafe, tumbler, notepad with pen, microphone.
Shape laptop();
Shape carafe();
Shape tumbler();
Shape notepad();
Shape microphone();

// A square of a coffered ceiling, `side` wide, its lower edges at y = 0, with a lamp in it.
struct Coffer {
  Shape frame, lamp;
};
Coffer coffer(double side);

// A hole of the same size in its place: reveals and glazing bars.
Shape roofLight(double side);

}  // namespace sundial::builtin
