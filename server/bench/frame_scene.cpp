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
  auto made = std::make_unique<Frame>(FrameView{.device = device_,
                                                .pipelines = pipelines_,
                                                .scene = buffers_,
                                                .target = target_,
                                                .reference = nullptr,
                                                .edges = nullptr,
                                                .light = sight_.light,
                                                .origin = origin_,
                                                .constants = constants()},
                                      method, make);
  need(runFrame(device_, made->passes(), {}));
  return made;
}

shared::FrameConstants FrameScene::constants() const {
  return frameConstants(*sight_.scene, sight_.view, sight_.light, target_.size(), origin_);
}

std::unique_ptr<Frame> FrameScene::frame(std::string_view method, MakeStore* make) const {
  return frame(need(parseMethod(method)), make);
}

std::vector<shared::ViewSample> FrameScene::samples() const {
  const auto values = [&](const GpuImage& image) {
    return valuesOf<glm::uvec4>(downloaded(device_, image, sizeof(glm::uvec4)));
  };
  const auto positions = values(target_.positions), normals = values(target_.normals);
  std::vector<shared::ViewSample> samples(positions.size());
  gatherSamples(positions.data(), normals.data(), samples);
  return samples;
}

std::vector<float> FrameScene::visibility() const {
  return valuesOf<float>(downloaded(device_, target_.visibility, sizeof(float)));
}

std::vector<float> FrameScene::reference() const {
  const auto asked = samples();
  std::vector<float> lit(asked.size());
  Reference(sight_.scene).trace(asked, sight_.light, origin_, lit, target_.size().x);
  return lit;
}

std::vector<std::uint8_t> FrameScene::facing() const {
  const auto asked = samples();
  std::vector<std::uint8_t> faces(asked.size());
  facesLight(asked, sight_.light, origin_, faces);
  return faces;
}

}  // namespace sundial::bench
