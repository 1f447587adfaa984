#include "shadow/triangle_store.h"

#include <algorithm>
#include <cstddef>

#include "shadow/plan_settings.h"
#include "shared/bindings.h"
#include "shared/samples.h"
#include "shared/wanted.h"

namespace sundial {

namespace {

constexpr VkDeviceSize kPackedBytes = 16;

std::uint64_t bitWordsOf(std::uint64_t texels) {
  return (texels + shared::kWantedWordBits - 1) / shared::kWantedWordBits;
}

// Whether triangles may have corners beyond their map: one of the whole scene holds all in sunlight.
bool reachBeyond(const Method& method, const shared::FrameConstants& constants) {
  return method.stages->volume != Volume::scene || constants.lightKind != shared::kLightDirectional;
}

// Whether there are so many texels that it pays to find out which ones lookups read.
bool packsWanted(const Method& method, const shared::FrameConstants& constants) {
  return texelsOf(mapSizesOf(method)) > std::uint64_t{constants.imageSize.x} * constants.imageSize.y;
}

}  // namespace

TriangleStore::TriangleStore(const Device& device, FramePipelines& pipelines, const Method& method,
                             const shared::FrameConstants& constants)
    : device_(device),
      ids_(device, pipelines, method, constants),
      want_(packsWanted(method, constants) ? pipelines.want(method) : VK_NULL_HANDLE),
      moreReach_(walksSurfaces(method) ? 0 : std::max(method.settings.kernel / 2, 1u)),
      pack_(pipelines.compute("pack_triangles.comp", {shadowViewsOf(method), reachBeyond(method, constants),
                                                      !packsWanted(method, constants), 0, 0, 0, 0, 0,
                                                      method.stages->partition == Partition::cube})) {
  takeRoom();
}

void TriangleStore::takeRoom() {
  const std::uint64_t texels = ids_.texels();
  packed_ = {device_,
             Buffer(device_, texels * kPackedBytes,
                    VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT),
             VK_FORMAT_R32G32B32A32_UINT, kPackedBytes};
  const std::uint64_t words = want_ ? bitWordsOf(texels) + texels : 0;
  wanted_ = {device_, sizeof(shared::WantedTexels) + words * sizeof(std::uint32_t),
             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT};
  device_.submit([&](VkCommandBuffer command) {
    vkCmdFillBuffer(command, wanted_, 0, VK_WHOLE_SIZE, 0);
    barrier(command);
  });
}

void TriangleStore::fit(const shared::Plan& plan) {
  const std::uint64_t before = ids_.texels();
  ids_.fit(plan);
  if (ids_.texels() != before) takeRoom();
}

void TriangleStore::filter(VkCommandBuffer command) const {
  if (!want_) pack(command);
}

void TriangleStore::gather(VkCommandBuffer command, std::uint32_t samples) const {
  if (!want_) return;
  constexpr std::uint32_t kPerGroup = shared::kSampleGroup * shared::kSamplesPerInvocation;
  const auto bitWords = static_cast<std::uint32_t>(bitWordsOf(ids_.texels()));
  const shared::WantedTexels none{0, bitWords, moreReach_};
  vkCmdUpdateBuffer(command, wanted_, 0, sizeof none, &none);
  vkCmdFillBuffer(command, wanted_, sizeof none, VkDeviceSize{bitWords} * sizeof(std::uint32_t), 0);
  barrier(command);
  vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, want_);
  vkCmdDispatch(command, (samples + kPerGroup - 1) / kPerGroup, 1, 1);
  barrier(command);
  pack(command);
}

void TriangleStore::gatherMore(VkCommandBuffer command) const {
  if (want_ && moreReach_ > 0) pack(command);
}

void TriangleStore::pack(VkCommandBuffer command) const {
  vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, pack_);
  vkCmdDispatch(command, shared::kPackGroups, 1, 1);
  barrier(command);
  vkCmdFillBuffer(command, wanted_, offsetof(shared::WantedTexels, count), sizeof(std::uint32_t), 0);
  barrier(command);
}

std::uint64_t TriangleStore::bytes() const {
  return ids_.bytes() + ids_.texels() * kPackedBytes + (want_ ? wanted_.size() : 0);
}

void TriangleStore::bindTo(BindingSet& bindings) const {
  ids_.bindTo(bindings);
  bindings.set(shared::kBindHeld, packed_);
  bindings.set(shared::kBindHeldWritten, packed_);
  bindings.set(shared::kBindWanted, wanted_);
}

}  // namespace sundial
