// The outline, in a light's space, of all that the camera could see lit.
#pragma once

#include <vector>

#include "shadow/lit_part.h"

namespace sundial {

// A convex polygon of light space after division, and how far what lies in it reaches.
struct Outline {
  std::vector<glm::dvec2> corners;  // as convexHull() gives them
  double farZ = 1e300;              // the least z
};

// Holds every sample that faces the light, but for those of triangles seen edge on, which rounding puts
// elsewhere (samples.frag): the hull of what could be seen lit of all triangles. It is found from the
// clusters' boxes, and from triangles wherever a box would be a corner of it, so that few clusters are looked
// into; some such boxes stay where it takes too many steps. A spot's cone is cut by lines around it.
Outline litOutline(const LitPart&, const PlacedClusters&);

}  // namespace sundial
