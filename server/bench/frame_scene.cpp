#include "bench/frame_scene.h"

#include "bench/program.h"
#include "shadow/camera.h"
#include "shadow/frame_runner.h"

namespace sundial::bench {

FrameScene::FrameScene(const Device& device, FramePipelines& pipelines, Sight sight, glm::uvec2 size)
    : device_(device),
      pipelines_(pipelines),
      sight_(std::move(sight)),
      origin_(frameOrigin(*sight_.scene, sight_.view)),
      target_(device, size),
      buffers_(device, sight_.scene) {
  sight_.light.direction = glm::normalize(sight_.light.direction);
  buffers_.moveTo(device_, origin_);
}

std::unique_ptr<Frame> FrameScene::frame(const Method& method, MakeStore* make) const {
  auto made = std::make_unique<Frame>(
      FrameView{
          .device = device_,
          .pipelines = pipelines_,
          .scene = buffers_,
          .target = target_,
          .reference = nullptr,
          .edges = nullptr,
          .light = sight_.light,
          .origin = origin_,
          .constants = frameConstants(*sight_.scene, sight_.view, sight_.light, target_.size(), origin_)},
      method, make);
  need(runFrame(device_, made->passes(), {}));
  return made;
}

std::unique_ptr<Frame> FrameScene::frame(std::string_view method, MakeStore* make) const {
  return frame(need(parseMethod(method)), make);
}

}  // namespace sundial::bench
