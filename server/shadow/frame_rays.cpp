// The passes of ray-traced, beside those of frame.cpp: view samples go to the host, which traces, and come
// back as visibility.
#include <cstring>

#include "gpu/rendering.h"
#include "shadow/frame.h"

namespace sundial {

void Frame::readSamples(VkCommandBuffer command) const {
  for (const auto& [image, buffer] : {std::pair(&view_.target.positions, &*hostPositions_),
                                      std::pair(&view_.target.normals, &*hostNormals_)})
    copyToBuffer(command, *image, *buffer);
}

void Frame::trace() const {
  const glm::uvec2 size = view_.constants.imageSize;
  std::vector<shared::ViewSample> samples(std::size_t{size.x} * size.y);
  gatherSamples(hostPositions_->mapped<glm::uvec4>(), hostNormals_->mapped<glm::uvec4>(), samples);
  view_.reference->trace(samples, view_.light, view_.origin,
                         {hostVisibility_->mapped<float>(), samples.size()}, size.x);
}

void Frame::takeVisibility(VkCommandBuffer command) const {
  copyToImage(command, *hostVisibility_, view_.target.visibility);
}

void gatherSamples(const glm::uvec4* positions, const glm::uvec4* normals,
                   std::span<shared::ViewSample> samples) {
  static_assert(sizeof(shared::ViewSample) == 2 * sizeof(glm::uvec4));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::memcpy(&samples[i], &positions[i], sizeof(glm::uvec4));
    std::memcpy(&samples[i].wsNormal, &normals[i], sizeof(glm::uvec4));
  }
}

}  // namespace sundial
