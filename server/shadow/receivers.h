// Which triangles the camera could see lit: what a sample of one needs to face the light (facesLight() in
// shaders/light.glsl), told from the triangle's plane alone.
#pragma once

#include "shadow/placed_clusters.h"
#include "shared/frame.h"

namespace sundial {

// Who looks at a triangle, relative to the frame's origin.
class Onlookers {
 public:
  explicit Onlookers(const shared::FrameConstants&);

  // False only where no sample of the triangle faces the light, whatever a sample's normal and position lose
  // by rounding: a sample's normal is its triangle's and faces the camera, so that camera and light must be
  // on the same side of its plane; on its front, if it is drawn from there alone. `stretch`: stretchOf() its
  // placement.
  bool mayBeLit(const PlacedTriangle&, bool doubleSided, double stretch) const;

 private:
  glm::dvec3 eye_;
  glm::dvec4 light_;   // where it is, 1; of a far one the way to it, a unit vector, 0
  double pixelWidth_;  // metres at depth 1
};

// A bound of how many times longer than another a vector becomes that was as long. `worldFromMesh` isn't
// singular.
double stretchOf(const glm::dmat4& worldFromMesh);

}  // namespace sundial
