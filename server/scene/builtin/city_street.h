// What stands in the city's streets and on its roofs. Each stands on the origin, y up, metres; long things
// lie along x. Painted.
#pragma once

#include "scene/builtin/shapes.h"

namespace sundial::builtin {

Shape streetLamp();    // its arm towards +z
Shape trafficLight();  // its arm 6 m towards +z, over the road
Shape bench();
Shape bollards();  // a row of five
Shape car(const glm::vec3& paint);
Shape van(const glm::vec3& paint);
Shape shelter();  // at a bus stop, open towards +z
Shape planter();

Shape waterTank();
Shape antennas();
Shape vents();  // ducts, fans and a row of pipes
Shape liftHouse();

// A wire from x = -span / 2 to span / 2, at y = 0 at its ends.
Shape wire(double span, double sag);

}  // namespace sundial::builtin
