// Renders with the validation layer on, and holds what came out in a form that tests ask questions of.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <initializer_list>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "renderer.h"
#include "scene/load.h"
#include "scene/scene_builder.h"

namespace sundial::test {

inline Method method(std::string_view text) {
  auto chosen = parseMethod(text);
  if (!chosen) throw std::invalid_argument(chosen.error().message);
  return *chosen;
}

inline std::shared_ptr<const Scene> sharedScene(Result<Scene> scene) {
  if (!scene) throw std::invalid_argument(scene.error().message);
  return std::make_shared<const Scene>(std::move(*scene));
}
inline std::shared_ptr<const Scene> builtin(std::string_view reference) {
  return sharedScene(makeBuiltin(reference));
}

inline View viewOf(const Scene& scene, std::string_view name) {
  for (const NamedView& view : scene.views)
    if (view.name == name) return view.view;
  throw std::invalid_argument(fmt::format("{} has no view {}", scene.name, name));
}
inline Light lightOf(const Scene& scene, std::string_view name) {
  for (const NamedLight& light : scene.lights)
    if (light.name == name) return light.light;
  throw std::invalid_argument(fmt::format("{} has no light {}", scene.name, name));
}
// Light from `azimuth` degrees around (0: from +x, 90: from +z) and `elevation` degrees above the horizon.
inline Light sun(double elevationDegrees, double azimuthDegrees) {
  const double elevation = glm::radians(elevationDegrees), azimuth = glm::radians(azimuthDegrees);
  return {.direction = -glm::dvec3(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                                   std::cos(elevation) * std::sin(azimuth))};
}
inline Light spot(const glm::dvec3& from, const glm::dvec3& to, double coneDegrees) {
  return {.kind = LightKind::spot,
          .direction = glm::normalize(to - from),
          .position = from,
          .coneDegrees = coneDegrees};
}
inline Light point(const glm::dvec3& from) { return {.kind = LightKind::point, .position = from}; }

inline constexpr std::initializer_list<Aov> kAllImages = {Aov::colour,   Aov::visibility, Aov::reference,
                                                          Aov::position, Aov::normal,     Aov::id,
                                                          Aov::view,     Aov::lookupClass};

// One method's part of a job.
struct Rendering {
  std::vector<PlanView> plan;
  std::map<Aov, Image> images;
  MethodResult result;

  std::size_t pixels() const {
    const glm::uvec2 size = images.begin()->second.size;
    return std::size_t{size.x} * size.y;
  }
  template <class T>
  T at(Aov aov, std::size_t pixel) const {
    T value;
    std::memcpy(&value, images.at(aov).bytes.data() + pixel * sizeof(T), sizeof(T));
    return value;
  }
  float visibility(std::size_t pixel) const { return at<float>(Aov::visibility, pixel); }
  float reference(std::size_t pixel) const { return at<float>(Aov::reference, pixel); }
  glm::dvec3 position(std::size_t pixel) const { return glm::dvec3(at<glm::vec3>(Aov::position, pixel)); }
  glm::dvec3 normal(std::size_t pixel) const { return glm::dvec3(at<glm::vec3>(Aov::normal, pixel)); }
  glm::uvec2 id(std::size_t pixel) const { return at<glm::uvec2>(Aov::id, pixel); }  // instance, triangle
  bool seen(std::size_t pixel) const { return id(pixel).x != shared::kNoInstance; }
  // Only samples that face the light are answered by a shadow view.
  bool answered(std::size_t pixel) const {
    return at<std::uint32_t>(Aov::view, pixel) != shared::kNoShadowView;
  }
  double work(std::string_view pass, std::string_view what) const {
    for (const PassTiming& timing : result.passes)
      for (const Work& work : timing.work)
        if (timing.name == pass && work.name == what) return work.count;
    throw std::invalid_argument(fmt::format("no {} of pass {}", what, pass));
  }
};

class Collector : public JobSink {
 public:
  void onPlan(std::size_t method, const std::vector<PlanView>& plan) override { at(method).plan = plan; }
  void onImage(std::size_t method, Image image) override {
    at(method).images.insert_or_assign(image.aov, std::move(image));
  }
  void onResult(std::size_t method, MethodResult result) override { at(method).result = std::move(result); }

  std::vector<Rendering> renderings;

 private:
  Rendering& at(std::size_t method) {
    if (renderings.size() <= method) renderings.resize(method + 1);
    return renderings[method];
  }
};

inline RenderJob jobOf(std::shared_ptr<const Scene> scene, const View& view, const Light& light,
                       glm::uvec2 size, std::initializer_list<std::string_view> methods,
                       std::initializer_list<Aov> images = {}, bool measures = false) {
  RenderJob job{.scene = std::move(scene),
                .view = view,
                .light = light,
                .size = size,
                .methods = {},
                .images = images,
                .measures = measures};
  for (const std::string_view text : methods) job.methods.push_back(method(text));
  return job;
}

// The one renderer of a test program. A test fails if the validation layer had anything to say.
class RendererTest : public ::testing::Test {
 protected:
  static Renderer& renderer() {
    static const std::unique_ptr<Renderer> instance = [] {
      auto made = Renderer::create("", true);
      if (!made) throw std::runtime_error(made.error().message);
      return std::move(*made);
    }();
    return *instance;
  }
  static std::vector<Rendering> render(const RenderJob& job) {
    Collector collector;
    const Result<void> done = renderer().run(job, {}, collector);
    if (!done) throw std::runtime_error(done.error().message);
    return std::move(collector.renderings);
  }
  // One method, with every image.
  static Rendering render(std::shared_ptr<const Scene> scene, const View& view, const Light& light,
                          glm::uvec2 size, std::string_view method) {
    return std::move(render(jobOf(std::move(scene), view, light, size, {method}, kAllImages, true)).front());
  }
  void TearDown() override { EXPECT_EQ(renderer().validationMessages(), 0u); }
};

}  // namespace sundial::test
