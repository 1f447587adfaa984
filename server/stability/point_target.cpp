#include "stability/point_target.h"

#include <cmath>
#include <cstring>

#include "shared/scene.h"

namespace sundial {

namespace {

glm::uvec2 sizeFor(std::uint32_t count) {
  const auto width = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  return {width, (count + width - 1) / width};
}

VkDeviceSize bytesFor(const ViewTarget& target) {
  return VkDeviceSize{target.size().x} * target.size().y * sizeof(glm::uvec4);
}

}  // namespace

PointTarget::PointTarget(const Device& device, std::uint32_t count)
    : target_(device, sizeFor(count)),
      positions_(device, bytesFor(target_), 0, MemoryUse::upload),
      normals_(device, bytesFor(target_), 0, MemoryUse::upload) {}

void PointTarget::set(std::span<const shared::ViewSample> samples) {
  points_ = samples.size();
  auto* const positions = positions_.mapped<glm::uvec4>();
  auto* const normals = normals_.mapped<glm::uvec4>();
  const std::size_t pixels = std::size_t{target_.size().x} * target_.size().y;
  for (std::size_t i = 0; i < pixels; ++i) {
    const shared::ViewSample sample =
        i < points_ ? samples[i] : shared::ViewSample{.instance = shared::kNoInstance};
    std::memcpy(&positions[i], &sample, sizeof(glm::uvec4));
    std::memcpy(&normals[i], &sample.wsNormal, sizeof(glm::uvec4));
  }
}

void PointTarget::recordUpload(VkCommandBuffer command) const {
  copyToImage(command, positions_, target_.positions);
  copyToImage(command, normals_, target_.normals);
}

std::vector<float> PointTarget::visibility(const Device& device) const {
  const std::vector<std::byte> bytes = downloaded(device, target_.visibility, sizeof(float));
  std::vector<float> visibility(points_);
  if (points_ > 0) std::memcpy(visibility.data(), bytes.data(), points_ * sizeof(float));
  return visibility;
}

}  // namespace sundial
