#include "reference/frame_light.h"

#include <cmath>

#include "reference/reference.h"

namespace sundial {

FrameLight::FrameLight(const Light& light, const glm::dvec3& origin)
    : kind(light.kind),
      wsDirection(light.direction),
      wsPosition(light.position - origin),
      cosCone(static_cast<float>(std::cos(glm::radians(light.coneDegrees) * 0.5))) {}

// Mirrored by the shaders, term by term. The cone is compared without normalising: a square root is exact on
// every device, an inverse square root isn't. Each comparison is false for NaN.
bool FrameLight::facedBy(const shared::ViewSample& sample) const {
  if (sample.instance == shared::kNoInstance) return false;
  const glm::vec3 toLight = towards(sample);
  if (!(glm::dot(sample.wsNormal, toLight) > 0.0f)) return false;
  if (kind != LightKind::spot) return true;
  return -glm::dot(toLight, wsDirection) >= cosCone * std::sqrt(glm::dot(toLight, toLight));
}

bool facesLight(const shared::ViewSample& sample, const Light& light, const glm::dvec3& origin) {
  return FrameLight(light, origin).facedBy(sample);
}

void facesLight(std::span<const shared::ViewSample> samples, const Light& light, const glm::dvec3& origin,
                std::span<std::uint8_t> faces) {
  const FrameLight frameLight(light, origin);
  for (std::size_t i = 0; i < samples.size(); ++i) faces[i] = frameLight.facedBy(samples[i]);
}

}  // namespace sundial
