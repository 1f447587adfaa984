// The passes of shadow-volumes, beside those of frame.cpp.
#include "gpu/rendering.h"
#include "shadow/frame.h"

namespace sundial {

// How many volumes each view sample is in. What the camera sees of the caps is what it sees of the scene.
void Frame::countVolumes(VkCommandBuffer command) const {
  const auto drawing = [&](std::uint32_t slot) {
    return [this, command, slot](VkPipeline caps) { drawSlot(command, slot, caps, caps, false); };
  };
  const bool ends = view_.constants.lightKind != shared::kLightDirectional;
  if (ends) cullFarCaps(command);
  bindings_.bind(command);
  volumes_->count(command, view_.pipelines.layout.pipeline(), drawing(shared::kCameraSlot),
                  ends ? drawing(1) : ShadowVolumes::DrawScene());
}

// Far caps lie at infinity: the camera sees those that it would see from the light's place.
void Frame::cullFarCaps(VkCommandBuffer command) const {
  shared::Plan plan{.viewCount = 1};
  const glm::dmat4 clipFromWorld(view_.constants.clipFromWorld);
  plan.views[0].shadowFromWorld = view_.constants.clipFromWorld;
  plan.views[0].shadowFromWorld[3] =
      clipFromWorld * glm::dvec4(-glm::dvec3(view_.constants.wsLightPosition), 0);
  vkCmdUpdateBuffer(command, plan_, 0, sizeof plan, &plan);
  barrier(command);
  cull(command, 1, 1);
}

void Frame::resolveVolumes(VkCommandBuffer command) const {
  bindings_.bind(command);
  renderInto(command, {&view_.target.visibility}, nullptr, [&] {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      view_.pipelines.fullscreen("resolve_volumes.frag", VK_FORMAT_R32_SFLOAT, {}));
    vkCmdDraw(command, 3, 1, 0, 0);
  });
}

}  // namespace sundial
