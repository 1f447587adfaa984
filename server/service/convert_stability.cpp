#include "service/convert_stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "scene/choose.h"
#include "service/convert_parts.h"
#include "stability/path.h"

namespace sundial {

namespace {

constexpr std::uint32_t kCaseSide = 512;  // pixels of a named case's frames

// The keys of a path given in the request, and its frames.
template <class Key, class Path>
Result<std::vector<Key>> keysOf(const Path& in, const std::string& field) {
  if (in.keys_size() < 1 || in.keys_size() > kMaxPathKeys)
    return invalid(
        fmt::format("{}.keys has {} entries: must have 1 to {}", field, in.keys_size(), kMaxPathKeys));
  if (auto frames = checkCount(field + ".frames", in.frames(), 1, kMaxStabilityFrames); !frames)
    return std::unexpected(frames.error());
  std::vector<Key> keys;
  for (int i = 0; i < in.keys_size(); ++i) {
    auto key = fromProto(in.keys(i), fmt::format("{}.keys[{}]", field, i));
    if (!key) return std::unexpected(std::move(key.error()));
    keys.push_back(*key);
  }
  return keys;
}

Result<void> takeCamera(const v1::StabilityRequest& in, StabilitySpec& spec) {
  if (in.has_path()) {
    auto keys = keysOf<View>(in.path(), "path");
    if (!keys) return std::unexpected(std::move(keys.error()));
    spec.keys = std::move(*keys);
    spec.ownFrames = in.path().frames();
  } else if (in.has_view()) {
    auto view = fromProto(in.view(), "view");
    if (!view) return std::unexpected(std::move(view.error()));
    spec.keys = {*view};
  } else if (in.has_path_name()) {
    if (auto named = checkedName(in.path_name(), "path_name"); !named) return std::unexpected(named.error());
    spec.pathName = in.path_name();
  } else if (in.has_view_name()) {
    if (auto named = checkedName(in.view_name(), "view_name"); !named) return std::unexpected(named.error());
    spec.viewName = in.view_name();
  }
  return {};
}

Result<void> takeLight(const v1::StabilityRequest& in, StabilitySpec& spec) {
  if (in.has_light_path()) {
    auto keys = keysOf<Light>(in.light_path(), "light_path");
    if (!keys) return std::unexpected(std::move(keys.error()));
    spec.lightKeys = std::move(*keys);
    if (spec.ownFrames == 0) spec.ownFrames = in.light_path().frames();
  } else if (in.has_light()) {
    auto light = fromProto(in.light(), "light");
    if (!light) return std::unexpected(std::move(light.error()));
    spec.lightKeys = {*light};
  } else if (in.has_light_path_name()) {
    if (auto named = checkedName(in.light_path_name(), "light_path_name"); !named)
      return std::unexpected(named.error());
    spec.lightPathName = in.light_path_name();
  } else if (in.has_light_name()) {
    if (auto named = checkedName(in.light_name(), "light_name"); !named)
      return std::unexpected(named.error());
    spec.lightName = in.light_name();
  }
  return {};
}

// What of the path is known only with the scene: keys, and frames that go before the light's.
Result<void> findCamera(StabilitySpec& spec, const Scene& scene) {
  if (spec.pathName) {
    auto path = choosePath(scene, *spec.pathName);
    if (!path) return std::unexpected(std::move(path.error()));
    spec.keys = std::move(path->keys);
    spec.ownFrames = path->frames;
  } else if (spec.keys.empty()) {
    const auto view = chooseView(scene, spec.viewName);
    if (!view) return std::unexpected(view.error());
    spec.keys = {*view};
  }
  return {};
}

Result<void> findLight(StabilitySpec& spec, const Scene& scene) {
  if (spec.lightPathName) {
    auto path = chooseLightPath(scene, *spec.lightPathName);
    if (!path) return std::unexpected(std::move(path.error()));
    spec.lightKeys = std::move(path->keys);
    if (spec.ownFrames == 0) spec.ownFrames = path->frames;
  } else if (spec.lightKeys.empty()) {
    const auto light = chooseLight(scene, spec.lightName);
    if (!light) return std::unexpected(light.error());
    spec.lightKeys = {*light};
  }
  return {};
}

}  // namespace

Result<StabilitySpec> fromProto(const v1::StabilityRequest& in, const RequestLimits& limits) {
  StabilitySpec spec;
  if (auto scene = checkedName(in.scene(), "scene"); !scene) return std::unexpected(scene.error());
  spec.scene = in.scene();
  if (auto camera = takeCamera(in, spec); !camera) return std::unexpected(std::move(camera.error()));
  if (auto light = takeLight(in, spec); !light) return std::unexpected(std::move(light.error()));

  const auto size = checkedSize(in.width(), in.height(), limits);
  if (!size) return std::unexpected(size.error());
  spec.job.size = *size;
  auto methods = methodsOf(in.methods());
  if (!methods) return std::unexpected(std::move(methods.error()));
  spec.job.methods = std::move(*methods);

  for (const auto& checked : {checkCount("frames", in.frames(), 0, kMaxStabilityFrames),
                              checkCount("points", in.points(), 0, kMaxStabilityPoints),
                              checkCount("pictures", in.pictures(), 0, kMaxStabilityPictures)})
    if (!checked) return std::unexpected(checked.error());
  spec.frames = in.frames();
  if (in.points() != 0) spec.job.points = in.points();
  spec.job.pictures = in.pictures();
  spec.job.pixels = in.pixels();
  spec.job.seed = in.seed();
  return spec;
}

Result<StabilityJob> withScene(StabilitySpec spec, std::shared_ptr<const Scene> scene,
                               const RequestLimits& limits) {
  if (auto camera = findCamera(spec, *scene); !camera) return std::unexpected(std::move(camera.error()));
  if (auto light = findLight(spec, *scene); !light) return std::unexpected(std::move(light.error()));
  const unsigned frames = std::max(spec.frames != 0 ? spec.frames : spec.ownFrames, 1u);
  auto views = viewsAlong(spec.keys, frames);
  if (!views) return std::unexpected(std::move(views.error()));
  auto lights = lightsAlong(spec.lightKeys, frames);
  if (!lights) return std::unexpected(std::move(lights.error()));

  StabilityJob job = std::move(spec.job);
  job.views = std::move(*views);
  job.lights = std::move(*lights);
  job.scene = std::move(scene);
  if (const std::uint64_t bytes = outputBytes(job); bytes > limits.outputBytes)
    return fail(
        ErrorCode::resourceExhausted,
        fmt::format("{} pictures of {} x {} pixels for {} methods are {} bytes, over this server's {}: "
                    "ask for less",
                    job.pictures, job.size.x, job.size.y, job.methods.size(), bytes, limits.outputBytes));
  return job;
}

std::uint64_t outputBytes(const StabilityJob& job) {
  const std::uint64_t pictures = std::min<std::uint64_t>(job.pictures, job.views.size());
  return pictures * job.methods.size() * job.size.x * job.size.y * 4;
}

void toProto(const StabilityPicture& in, v1::PictureBegin* out) {
  out->set_frame(in.frame);
  out->set_width(in.size.x);
  out->set_height(in.size.y);
  out->set_bytes(in.colour.size());
  for (const StabilityPicture::Mark& mark : in.flipped) {
    v1::FlippedPoint* to = out->add_flipped();
    to->set_x(mark.pixel.x);
    to->set_y(mark.pixel.y);
    to->set_lit(mark.lit);
  }
}

void toProto(const StabilityResult& in, v1::StabilityResult* out) {
  out->set_method(std::string(in.method.row->name));
  for (const auto& [name, value] : in.method.parameters) (*out->mutable_parameters())[name] = value;
  out->set_flip_rate(in.flipRate);
  out->set_pop(in.pop);
  out->set_texel_jump(in.texelJump);
  out->set_wrong_rate(in.wrongRate);
  out->set_bleed(in.bleed);
  out->set_drawn(in.drawn);
  out->set_wrong_pixels(in.wrongPixels);
  out->set_points(static_cast<double>(in.points));
  double pairs = 0;
  for (const StabilityFrame& frame : in.frames) {
    pairs += static_cast<double>(frame.pairs);
    out->add_flips_per_frame(static_cast<double>(frame.flips));
    out->add_pairs_per_frame(static_cast<double>(frame.pairs));
    out->add_plan_jumps(frame.texelJump);
    out->add_wrong_per_frame(static_cast<double>(frame.wrong));
  }
  out->set_pairs(pairs);
}

void toProto(const StabilityCase& in, v1::StabilityCase* out) {
  out->set_name(std::string(in.name));
  out->set_sentence(std::string(in.sentence));
  out->set_measure(std::string(in.measure));
  out->set_tells_apart(in.failsAbove > 0);
  out->set_fails_above(in.failsAbove);
  out->set_at_most(in.atMost);

  v1::StabilityRequest& request = *out->mutable_request();
  request.set_scene(std::string(in.scene));
  if (!in.path.empty()) request.set_path_name(std::string(in.path));
  if (!in.view.empty()) request.set_view_name(std::string(in.view));
  request.set_light_name(std::string(in.light));
  request.set_frames(in.frames);
  request.set_width(kCaseSide);
  request.set_height(kCaseSide);
  request.set_seed(1);
  request.set_pixels(in.measure == "wrong_pixels");
  // "sm,texels=512 dv": methods between spaces, what differs from their defaults between commas.
  std::istringstream methods{std::string(in.methods)};
  for (std::string method; methods >> method;) {
    std::istringstream parts(method);
    v1::MethodChoice& choice = *request.add_methods();
    std::getline(parts, *choice.mutable_name(), ',');
    for (std::string part; std::getline(parts, part, ',');) {
      const std::size_t equals = part.find('=');
      (*choice.mutable_parameters())[part.substr(0, equals)] = part.substr(equals + 1);
    }
  }
  if (in.twinScene.empty()) return;
  *out->mutable_twin() = request;
  out->mutable_twin()->set_scene(std::string(in.twinScene));
}

}  // namespace sundial
