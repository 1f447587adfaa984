// A light as the frame's shaders know it: in single precision, relative to the frame's origin.
#pragma once

#include <glm/glm.hpp>

#include "scene/view.h"
#include "shared/frame.h"

namespace sundial {

struct FrameLight {
  FrameLight(const Light&, const glm::dvec3& origin);

  // From the sample to the light, metres; directional: unit length, without an end.
  glm::vec3 towards(const shared::ViewSample& sample) const {
    return kind == LightKind::directional ? -wsDirection : wsPosition - sample.wsPosition;
  }
  bool facedBy(const shared::ViewSample&) const;

  LightKind kind;
  glm::vec3 wsDirection;  // FrameConstants::wsLightDirection
  glm::vec3 wsPosition;   // FrameConstants::wsLightPosition
  float cosCone;          // FrameConstants::lightCosCone
};

}  // namespace sundial
