#include "sweep/case_id.h"

#include <fmt/format.h>

#include "sundial/content_digest.h"
#include "sundial/method_choice.h"

namespace sundial::sweep {
namespace {

constexpr std::size_t kDigits = 16;

std::string text(const v1::Vec3& v) { return fmt::format("{},{},{}", v.x(), v.y(), v.z()); }

std::string text(const v1::View& view) {
  return fmt::format("eye {} target {} up {} fov {}", text(view.eye()), text(view.target()), text(view.up()),
                     view.vertical_fov_degrees());
}

std::string text(const v1::Light& light) {
  if (light.has_sun()) return "sun " + text(light.sun().direction());
  if (light.has_point()) return "point " + text(light.point().position());
  return fmt::format("spot {} to {} cone {}", text(light.spot().eye()), text(light.spot().target()),
                     light.spot().cone_degrees());
}

std::string viewOf(const v1::RenderRequest& request) {
  if (request.has_view_name()) return "name " + request.view_name();
  return request.has_view() ? text(request.view()) : "default";
}

std::string lightOf(const v1::RenderRequest& request) {
  if (request.has_light_name()) return "name " + request.light_name();
  return request.has_light() ? text(request.light()) : "default";
}

// Frames are apart: a request's own go before a path's.
template <class Path>
void addKeys(const Path& path, ContentDigest& digest) {
  digest.add(fmt::format("{} keys", path.keys_size()));
  for (const auto& key : path.keys()) digest.add(text(key));
}

void addMotion(const v1::StabilityRequest& along, ContentDigest& digest) {
  digest.add("camera");
  if (along.has_path_name()) digest.add("name " + along.path_name());
  if (along.has_path()) addKeys(along.path(), digest);
  digest.add("light");
  if (along.has_light_path_name()) digest.add("name " + along.light_path_name());
  if (along.has_light_path()) addKeys(along.light_path(), digest);
  digest.add(fmt::format("frames {} points {} seed {}", along.frames(), along.points(), along.seed()));
}

}  // namespace

std::string idOf(const Case& one) {
  ContentDigest digest;
  digest.add("case");
  digest.add(one.request.scene());
  digest.add(viewOf(one.request));
  digest.add(lightOf(one.request));
  digest.add(fmt::format("{}x{}", one.request.width(), one.request.height()));
  digest.add(client::methodLabel(one.request.methods(0)));
  if (one.along) addMotion(*one.along, digest);
  return digest.hexadecimal().substr(0, kDigits);
}

}  // namespace sundial::sweep
