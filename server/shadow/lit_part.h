// The part of the world in which a map's samples can lie: what both the camera and the light see.
#pragma once

#include <limits>

#include "shadow/box_clip.h"
#include "shadow/receivers.h"

namespace sundial {

struct LitPart {
  glm::mat4 lightFromWorld;
  Planes planes;  // pointing inwards, around the camera's frustum and the light's; without far planes
  Onlookers onlookers;
  double coneRadius = std::numeric_limits<double>::infinity();  // of a spot's cone at one metre
};

// From the constants of a settled frame (plan_settings.h), before light space is turned.
LitPart litPart(const shared::FrameConstants&);
// For a face of a cube about the light: what its pyramid leaves.
LitPart litPartOfFace(const shared::FrameConstants&, std::uint32_t face);

}  // namespace sundial
