#include "sweep/group.h"

#include <fmt/format.h>

#include "sundial/read_text.h"

namespace sundial::sweep {
namespace {

using client::Expected;
namespace fs = std::filesystem;

constexpr unsigned kUsualSide = 1024;                                          // pixels
constexpr unsigned kMostKeys = 1000, kMostFrames = 2000, kMostPoints = 65536;  // as the contract says
constexpr unsigned kUsualPoints = 4096, kUsualSeed = 1;

std::unexpected<client::Error> refuse(std::string why) {
  return client::fail(grpc::INVALID_ARGUMENT, std::move(why));
}

bool moves(const v1::SweepGroup& group) { return !group.path().empty() || !group.light_path().empty(); }

// Nothing that can be seen without a server is left to fail on the way.
Expected<void> check(const v1::SweepGroup& group) {
  if (group.scene().empty()) return refuse("it names no scene");
  if (group.method().empty()) return refuse("it names no method");
  for (const v1::SweepSize& size : group.size())
    if (size.width() == 0 || size.height() == 0)
      return refuse(fmt::format("size is {}x{}; both must be at least 1", size.width(), size.height()));
  for (const v1::SweepView& view : group.view())
    if (view.name().empty() && !view.has_view()) return refuse("a view has neither a name nor a view");
  for (const v1::SweepLight& light : group.light())
    if (light.name().empty() && light.light().kind_case() == v1::Light::KIND_NOT_SET)
      return refuse("a light has neither a name nor a sun, spot or point");
  if (!moves(group) && (group.frames() != 0 || group.points() != 0 || group.has_seed()))
    return refuse(
        "frames, points and seed are of what moves, and nothing does; give it a path or a light_path");
  if (group.frames() > kMostFrames)
    return refuse(fmt::format("frames is {}; must lie in [1, {}]", group.frames(), kMostFrames));
  if (group.points() > kMostPoints)
    return refuse(fmt::format("points is {}; must lie in [1, {}]", group.points(), kMostPoints));
  return {};
}

void complete(v1::View& view) {
  if (!view.has_up()) view.mutable_up()->set_y(1);
  if (view.vertical_fov_degrees() == 0) view.set_vertical_fov_degrees(60);
}

// A path or a light path; `frames` of the group.
template <class Path>
Expected<void> complete(Path& path, const char* field, unsigned frames, const fs::path& folder) {
  if (!path.file().empty()) {
    if (path.has_keys())
      return refuse(fmt::format("{} has keys and the file {}; give one of them", field, path.file()));
    if (auto read = client::readText(folder / path.file(), *path.mutable_keys()); !read) {
      read.error().message = fmt::format("{}: {}", field, read.error().message);
      return read;
    }
    if (path.name().empty()) path.set_name(fs::path(path.file()).stem().string());
    path.clear_file();
  }
  if (path.name().empty()) return refuse(fmt::format("a {} has neither a name nor a file", field));
  if (!path.has_keys()) return {};
  const int keys = path.keys().keys_size();
  if (keys < 1 || keys > static_cast<int>(kMostKeys))
    return refuse(fmt::format("{} '{}' has {} keys; must have 1 to {}", field, path.name(), keys, kMostKeys));
  if (frames != 0) path.mutable_keys()->set_frames(frames);
  if (path.keys().frames() < 1 || path.keys().frames() > kMostFrames)
    return refuse(fmt::format("{} '{}' has {} frames; must have 1 to {}: give it or its group some", field,
                              path.name(), path.keys().frames(), kMostFrames));
  return {};
}

}  // namespace

Expected<v1::SweepGroup> complete(v1::SweepGroup group, const fs::path& folder) {
  if (auto checked = check(group); !checked) return std::unexpected(checked.error());
  if (group.size().empty()) {
    v1::SweepSize& usual = *group.add_size();
    usual.set_width(kUsualSide);
    usual.set_height(kUsualSide);
  }
  for (v1::SweepView& view : *group.mutable_view())
    if (view.has_view()) complete(*view.mutable_view());
  for (v1::SweepPath& path : *group.mutable_path()) {
    if (auto done = complete(path, "path", group.frames(), folder); !done)
      return std::unexpected(done.error());
    if (path.has_keys())
      for (v1::View& key : *path.mutable_keys()->mutable_keys()) complete(key);
  }
  for (v1::SweepLightPath& path : *group.mutable_light_path())
    if (auto done = complete(path, "light_path", group.frames(), folder); !done)
      return std::unexpected(done.error());
  if (!moves(group)) return group;
  if (group.points() == 0) group.set_points(kUsualPoints);
  if (!group.has_seed()) group.set_seed(kUsualSeed);
  return group;
}

}  // namespace sundial::sweep
