// What a frame holds when it has run: for the host to read, and in bytes.
#include <cstring>

#include "shadow/frame.h"
#include "shadow/plan_settings.h"

namespace sundial {

shared::Plan Frame::downloadPlan() const {
  shared::Plan plan{};
  if (!method_.stages) return plan;
  const std::vector<std::byte> bytes = downloaded(view_.device, plan_);
  std::memcpy(&plan, bytes.data(), sizeof plan);
  return plan;
}

WarpTables Frame::downloadWarp() const {
  if (!warp_) return {};
  return {valuesOf<glm::vec2>(downloaded(view_.device, warp_->functions())),
          valuesOf<glm::vec2>(downloaded(view_.device, warp_->centres()))};
}

std::vector<float> Frame::downloadDepths() const { return store_ ? store_->depths() : std::vector<float>(); }

std::uint64_t Frame::storeTexels() const { return store_ ? store_->texels() : 0; }

std::uint64_t Frame::storeBytes() const { return store_ ? store_->bytes() : 0; }

std::uint64_t Frame::usedStoreBytes(const shared::Plan& plan) const {
  const bool estimated = method_.stages && method_.stages->resolution == Resolution::estimated;
  return estimated ? texelsOf(plan) * storeBytes() / storeTexels() : storeBytes();
}

std::uint64_t Frame::otherBytes() const {
  std::uint64_t bytes = 0;
  if (volumes_)
    bytes += volumes_->bytes() + view_.edges->bytes() + commands_.size() + visible_.size() + counts_.size();
  if (method_.stages)
    bytes += analysis_.size() + plan_.size() + commands_.size() + visible_.size() + counts_.size();
  if (warp_) bytes += warp_->bytes();
  for (const auto* buffer :
       {&hostPlan_, &hostCommands_, &hostCounts_, &hostPositions_, &hostNormals_, &hostVisibility_})
    if (*buffer) bytes += (*buffer)->size();
  return bytes;
}

}  // namespace sundial
