#include "shadow/triangle_store.h"

#include "gpu/rendering.h"
#include "shadow/plan_settings.h"
#include "shared/bindings.h"
#include "shared/triangle_texel.h"

namespace sundial {

namespace {

VkExtent2D extentOf(std::uint64_t texels) {
  return {shared::kHeldPitch,
          static_cast<std::uint32_t>((texels + shared::kHeldPitch - 1) / shared::kHeldPitch)};
}

// Whether triangles may have corners beyond their map: one of the whole scene holds all in sunlight.
bool reachBeyond(const Method& method, const shared::FrameConstants& constants) {
  return method.stages->volume != Volume::scene || constants.lightKind != shared::kLightDirectional;
}

}  // namespace

TriangleStore::TriangleStore(const Device& device, FramePipelines& pipelines, const Method& method,
                             const shared::FrameConstants& constants)
    : device_(device),
      ids_(device, pipelines, method, constants),
      pack_(pipelines.fullscreen("pack_triangles.frag", VK_FORMAT_R32G32B32A32_UINT,
                                 {shadowViewsOf(method), reachBeyond(method, constants), 0, 0, 0, 0, 0, 0,
                                  method.stages->partition == Partition::cube})),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)) {
  takeRoom();
}

void TriangleStore::takeRoom() {
  packed_ = GpuImage(device_, extentOf(ids_.texels()), VK_FORMAT_R32G32B32A32_UINT,
                     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
  device_.submit([&](VkCommandBuffer command) {
    transition(command, packed_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

void TriangleStore::fit(const shared::Plan& plan) {
  ids_.fit(plan);
  if (extentOf(ids_.texels()).height != packed_.extent().height) takeRoom();
}

void TriangleStore::filter(VkCommandBuffer command) const {
  renderInto(command, {&packed_}, nullptr, [&] {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS, pack_);
    vkCmdDraw(command, 3, 1, 0, 0);
  });
}

void TriangleStore::bindTo(BindingSet& bindings) const {
  ids_.bindTo(bindings);
  bindings.set(shared::kBindHeld, packed_, nearest_);
}

}  // namespace sundial
