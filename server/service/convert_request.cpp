#include <fmt/format.h>

#include <cmath>
#include <glm/glm.hpp>

#include "scene/choose.h"
#include "service/convert_parts.h"

namespace sundial {

namespace {

glm::dvec3 vec(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::string text(const glm::dvec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

Result<glm::dvec3> finite(const v1::Vec3& v, const std::string& field) {
  // Squares of anything longer leave the range of the single precision in which shaders work.
  constexpr double kFarthest = 1e15;
  for (const double x : {v.x(), v.y(), v.z()}) {
    if (!std::isfinite(x) || std::abs(x) > kFarthest) {
      return invalid(
          fmt::format("{} is {}: must be three finite numbers, each in [-1e15, 1e15]", field, text(vec(v))));
    }
  }
  return vec(v);
}

Result<glm::dvec3> direction(const glm::dvec3& v, const std::string& field, const std::string& what) {
  const double length = glm::length(v);
  if (length < 1e-12) return invalid(fmt::format("{} {}", field, what));
  return v / length;
}

Result<Aov> aovOf(int value, int index) {
  switch (value) {
    case v1::COLOUR:
      return Aov::colour;
    case v1::VISIBILITY:
      return Aov::visibility;
    case v1::REFERENCE:
      return Aov::reference;
    case v1::POSITION:
      return Aov::position;
    case v1::NORMAL:
      return Aov::normal;
    case v1::ID:
      return Aov::id;
    case v1::VIEW:
      return Aov::view;
    case v1::CLASS:
      return Aov::lookupClass;
    default:
      return invalid(
          fmt::format("images[{}] is {}: must be a value of Aov, in [1, {}]", index, value, kAovCount));
  }
}

std::uint64_t bytesPerPixel(Aov aov) {
  switch (aov) {
    case Aov::colour:
      return bytesPerPixel(Image::Format::rgba8);
    case Aov::visibility:
    case Aov::reference:
      return bytesPerPixel(Image::Format::r32f);
    case Aov::position:
    case Aov::normal:
      return bytesPerPixel(Image::Format::rgb32f);
    case Aov::id:
      return bytesPerPixel(Image::Format::rg32u);
    case Aov::view:
    case Aov::lookupClass:
      return bytesPerPixel(Image::Format::r32u);
  }
  return 0;
}

}  // namespace

Result<View> fromProto(const v1::View& in, const std::string& field) {
  View view;
  const auto eye = finite(in.eye(), field + ".eye");
  const auto target = finite(in.target(), field + ".target");
  const auto up = in.has_up() ? finite(in.up(), field + ".up") : Result<glm::dvec3>(glm::dvec3(0, 1, 0));
  for (const auto* v : {&eye, &target, &up}) {
    if (!*v) return std::unexpected(v->error());
  }
  const auto forward = direction(*target - *eye, field + ".target",
                                 fmt::format("is {}, where eye is: must differ", text(*target)));
  if (!forward) return std::unexpected(forward.error());
  const auto upward = direction(*up, field + ".up", "is 0,0,0: must be a direction");
  if (!upward) return std::unexpected(upward.error());
  if (glm::length(glm::cross(*forward, *upward)) < 1e-6) {
    return invalid(fmt::format("{}.up is {}: must not be parallel to target - eye, {}", field, text(*up),
                               text(*target - *eye)));
  }
  view.eye = *eye;
  view.target = *target;
  view.up = *up;
  view.verticalFovDegrees = in.vertical_fov_degrees();
  if (!(view.verticalFovDegrees > 0 && view.verticalFovDegrees < 180)) {
    return invalid(
        fmt::format("{}.vertical_fov_degrees is {}: must lie in (0, 180)", field, view.verticalFovDegrees));
  }
  return view;
}

Result<Light> fromProto(const v1::Light& in, const std::string& field) {
  Light light;
  switch (in.kind_case()) {
    case v1::Light::kSun: {
      const auto travel = finite(in.sun().direction(), field + ".sun.direction");
      if (!travel) return std::unexpected(travel.error());
      const auto unit = direction(*travel, field + ".sun.direction", "is 0,0,0: must be a direction");
      if (!unit) return std::unexpected(unit.error());
      light.kind = LightKind::directional;
      light.direction = *unit;
      return light;
    }
    case v1::Light::kSpot: {
      const auto eye = finite(in.spot().eye(), field + ".spot.eye");
      if (!eye) return std::unexpected(eye.error());
      const auto target = finite(in.spot().target(), field + ".spot.target");
      if (!target) return std::unexpected(target.error());
      const auto unit = direction(*target - *eye, field + ".spot.target",
                                  fmt::format("is {}, where eye is: must differ", text(*target)));
      if (!unit) return std::unexpected(unit.error());
      light.kind = LightKind::spot;
      light.position = *eye;
      light.direction = *unit;
      light.coneDegrees = in.spot().cone_degrees();
      if (!(light.coneDegrees > 0 && light.coneDegrees <= 170)) {
        return invalid(
            fmt::format("{}.spot.cone_degrees is {}: must lie in (0, 170]", field, light.coneDegrees));
      }
      return light;
    }
    case v1::Light::kPoint: {
      const auto position = finite(in.point().position(), field + ".point.position");
      if (!position) return std::unexpected(position.error());
      light.kind = LightKind::point;
      light.position = *position;
      return light;
    }
    case v1::Light::KIND_NOT_SET:
      break;
  }
  return invalid(field + ".kind isn't set: give sun, spot or point");
}

Result<RenderSpec> fromProto(const v1::RenderRequest& in, const RequestLimits& limits) {
  RenderSpec spec;
  if (auto scene = checkedName(in.scene(), "scene"); !scene) return std::unexpected(scene.error());
  spec.scene = in.scene();

  // The view and the light, where they don't depend on the scene.
  if (in.has_view()) {
    auto view = fromProto(in.view(), "view");
    if (!view) return std::unexpected(std::move(view.error()));
    spec.view = *view;
  } else if (in.has_view_name()) {
    if (auto named = checkedName(in.view_name(), "view_name"); !named) return std::unexpected(named.error());
    spec.viewName = in.view_name();
  }
  if (in.has_light()) {
    auto light = fromProto(in.light(), "light");
    if (!light) return std::unexpected(std::move(light.error()));
    spec.light = *light;
  } else if (in.has_light_name()) {
    if (auto named = checkedName(in.light_name(), "light_name"); !named)
      return std::unexpected(named.error());
    spec.lightName = in.light_name();
  }

  // The size.
  const auto size = checkedSize(in.width(), in.height(), limits);
  if (!size) return std::unexpected(size.error());
  spec.job.size = *size;

  // The methods.
  auto methods = methodsOf(in.methods());
  if (!methods) return std::unexpected(std::move(methods.error()));
  spec.job.methods = std::move(*methods);
  if (in.has_baseline()) {
    auto method = methodOf(in.baseline(), "baseline");
    if (!method) return std::unexpected(std::move(method.error()));
    spec.job.baseline = std::move(*method);
  }
  for (const auto& checked : {checkCount("repetitions", in.repetitions(), 0, kMaxRepetitions),
                              checkCount("max_repetitions", in.max_repetitions(), 0, kMaxRepetitions)})
    if (!checked) return std::unexpected(checked.error());
  spec.job.repetitions = in.repetitions();
  spec.job.maxRepetitions = in.max_repetitions();
  if (!(in.quartile_target() >= 0 && std::isfinite(in.quartile_target()))) {
    return invalid(
        fmt::format("quartile_target is {}: must be a finite number of at least 0", in.quartile_target()));
  }
  spec.job.quartileTarget = in.quartile_target();
  spec.job.measures = in.measures();

  // The images.
  std::uint64_t pixelBytes = 0;
  for (int i = 0; i < in.images_size(); ++i) {
    const auto aov = aovOf(in.images(i), i);
    if (!aov) return std::unexpected(aov.error());
    if (std::ranges::find(spec.job.images, *aov) != spec.job.images.end()) {
      return invalid(fmt::format("images[{}] is {}, which comes before: name each image once", i,
                                 v1::Aov_Name(in.images(i))));
    }
    spec.job.images.push_back(*aov);
    pixelBytes += bytesPerPixel(*aov);
  }
  spec.outputBytes = pixelBytes * in.width() * in.height() * static_cast<std::uint64_t>(in.methods_size());
  if (spec.outputBytes > limits.outputBytes) {
    return fail(
        ErrorCode::resourceExhausted,
        fmt::format(
            "images of {} x {} pixels for {} methods are {} bytes, over this server's {}: ask for less",
            in.width(), in.height(), in.methods_size(), spec.outputBytes, limits.outputBytes));
  }
  return spec;
}

Result<RenderJob> withScene(RenderSpec spec, std::shared_ptr<const Scene> scene) {
  RenderJob job = std::move(spec.job);
  const auto view = spec.view ? Result<View>(*spec.view) : chooseView(*scene, spec.viewName);
  if (!view) return std::unexpected(view.error());
  const auto light = spec.light ? Result<Light>(*spec.light) : chooseLight(*scene, spec.lightName);
  if (!light) return std::unexpected(light.error());
  job.view = *view;
  job.light = *light;
  job.scene = std::move(scene);
  return job;
}

}  // namespace sundial
