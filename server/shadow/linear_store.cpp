#include "shadow/linear_store.h"

#include "shadow/plan_settings.h"
#include "shadow/raster_choice.h"
#include "shared/bindings.h"

namespace sundial {

namespace {

TexelBuffer makeMaps(const Device& device, std::uint64_t texels, std::uint64_t bytesPerTexel) {
  return {device,
          Buffer(device, texels * bytesPerTexel,
                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT),
          bytesPerTexel == 4 ? VK_FORMAT_R32_UINT : VK_FORMAT_R32G32_UINT,
          static_cast<std::uint32_t>(bytesPerTexel)};
}

RasterChoice rasterOf(const Stages& stages) {
  return {.ids = keepsIds(stages.storage),
          .coverage = asksTriangles(stages.lookup) ? shared::kCoverConservative : shared::kCoverCentre,
          .warp = stages.warp,
          .cube = stages.warp != Warp::none && stages.partition == Partition::cube};
}

}  // namespace

LinearStore::LinearStore(const Device& device, FramePipelines& pipelines, const Method& method,
                         const shared::FrameConstants& constants)
    : LinearStore(device, pipelines, method, constants, rasterOf(*method.stages)) {}

LinearStore::LinearStore(const Device& device, FramePipelines& pipelines, const Method& method,
                         const shared::FrameConstants& constants, const RasterChoice& choice)
    : device_(device),
      estimated_(method.stages->resolution == Resolution::estimated),
      texels_(texelsOf(mapSizesOf(method))),
      bytesPerTexel_(choice.ids ? 8 : 4),
      maps_(makeMaps(device, texels_, bytesPerTexel_)),
      rasteriser_(device, pipelines, choice, shadowViewsOf(method), constants),
      unread_(device, {1, 1}, VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_SAMPLED_BIT),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)) {
  device.submit([&](VkCommandBuffer command) {
    transition(command, unread_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

void LinearStore::record(VkCommandBuffer command, const DrawView&) const {
  vkCmdFillBuffer(command, static_cast<const Buffer&>(maps_), 0, VK_WHOLE_SIZE, 0);
  rasteriser_.record(command);
}

void LinearStore::fit(const shared::Plan& plan) {
  if (!estimated_ || texelsOf(plan) == texels_) return;
  texels_ = texelsOf(plan);
  maps_ = makeMaps(device_, texels_, bytesPerTexel_);
}

bool LinearStore::again() {
  if (!rasteriser_.overflowed()) return false;
  rasteriser_.makeRoom();
  return true;
}

std::vector<Work> LinearStore::work() const {
  return {{"primitives", static_cast<double>(rasteriser_.triangles())}};
}

std::vector<float> LinearStore::depths() const {
  const auto words = valuesOf<float>(downloaded(device_, maps_));
  const std::size_t stride = bytesPerTexel_ / sizeof(float);
  std::vector<float> out(texels_);
  for (std::size_t i = 0; i < texels_; ++i) out[i] = words[stride * i + stride - 1];  // behind the triangle
  return out;
}

void LinearStore::bindTo(BindingSet& bindings) const {
  bindNoStore(bindings, unread_, nearest_, maps_);
  rasteriser_.bindTo(bindings);
}

}  // namespace sundial
