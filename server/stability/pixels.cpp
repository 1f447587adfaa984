#include "stability/pixels.h"

#include "shadow/frame.h"

namespace sundial {

std::vector<shared::ViewSample> samplesIn(const Device& device, const ViewTarget& target) {
  const auto positions = valuesOf<glm::uvec4>(downloaded(device, target.positions, sizeof(glm::uvec4)));
  const auto normals = valuesOf<glm::uvec4>(downloaded(device, target.normals, sizeof(glm::uvec4)));
  std::vector<shared::ViewSample> samples(positions.size());
  gatherSamples(positions.data(), normals.data(), samples);
  return samples;
}

PixelCount countPixels(const Device& device, const ViewTarget& target, const Reference& reference,
                       const Light& light, const glm::dvec3& origin) {
  const std::vector<shared::ViewSample> samples = samplesIn(device, target);
  const auto visibility = valuesOf<float>(downloaded(device, target.visibility, sizeof(float)));
  std::vector<float> truth(samples.size());
  reference.trace(samples, light, origin, truth);
  PixelCount count;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].instance == shared::kNoInstance) continue;
    ++count.seen;
    if ((visibility[i] >= 0.5f) != (truth[i] >= 0.5f)) ++count.wrong;
  }
  return count;
}

}  // namespace sundial
