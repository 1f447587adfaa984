#include "scene_root.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace sundial {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kNamesInError = 12;

bool isScene(const fs::path& path) { return path.extension() == ".glb" || path.extension() == ".gltf"; }

std::optional<FileStamp> stampOf(const fs::path& path) {
  std::error_code error;
  FileStamp stamp{path, fs::last_write_time(path, error), 0};
  if (error) return std::nullopt;
  stamp.size = fs::file_size(path, error);
  if (error) return std::nullopt;
  return stamp;
}

}  // namespace

Result<SceneRoot> SceneRoot::open(const fs::path& folder) {
  std::error_code error;
  const fs::path canonical = fs::canonical(folder, error);
  if (error) {
    return invalid(
        fmt::format("scene root {}: {}; give a folder that exists", folder.string(), error.message()));
  }
  if (!fs::is_directory(canonical, error)) {
    return invalid(fmt::format("scene root {} is no folder", folder.string()));
  }
  return SceneRoot(canonical);
}

bool SceneRoot::contains(const fs::path& canonical) const {
  return std::mismatch(root_.begin(), root_.end(), canonical.begin(), canonical.end()).first == root_.end();
}

Result<fs::path> SceneRoot::resolve(std::string_view name) const {
  const fs::path relative(name);
  const auto leaves = [&] {
    return invalid(fmt::format("scene '{}' leads out of the scene root: name a file under it", name));
  };
  if (relative.is_absolute() || std::ranges::find(relative, "..") != relative.end()) return leaves();
  std::error_code error;
  fs::path path = fs::canonical(root_ / relative, error);
  if (!error && !contains(path)) return leaves();
  if (error || !fs::is_regular_file(path, error) || !isScene(relative)) {
    std::vector<std::string> names = list(kNamesInError + 1);
    const bool more = names.size() > kNamesInError;
    if (more) names.resize(kNamesInError);
    return fail(
        ErrorCode::notFound,
        fmt::format("no scene '{}' under the scene root; there {}: {}{}", name,
                    names.size() == 1 ? "is" : "are",
                    names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")), more ? ", ..." : ""));
  }
  return path;
}

std::vector<std::string> SceneRoot::list(std::size_t limit) const {
  std::vector<std::string> names;
  std::error_code error;
  fs::recursive_directory_iterator it(root_, fs::directory_options::skip_permission_denied, error), end;
  for (; !error && it != end && names.size() < limit; it.increment(error)) {
    if (!isScene(it->path())) continue;
    std::error_code unreadable;
    const fs::path canonical = fs::canonical(it->path(), unreadable);
    if (unreadable || !contains(canonical) || !fs::is_regular_file(canonical, unreadable)) continue;
    names.push_back(it->path().lexically_relative(root_).generic_string());
  }
  std::ranges::sort(names);
  return names;
}

std::optional<std::vector<FileStamp>> stampsOf(const fs::path& main, const SceneFiles& files,
                                               fs::file_time_type readBegan) {
  const auto latest = readBegan - std::chrono::milliseconds(20);  // file times are coarser than the clock
  std::vector<FileStamp> stamps;
  for (const auto& [name, content] : files.files) {
    const auto stamp = stampOf(name == files.main ? main : main.parent_path() / name);
    if (!stamp || stamp->size != content.size() || stamp->time >= latest) return std::nullopt;
    stamps.push_back(*stamp);
  }
  return stamps;
}

bool unchanged(const std::vector<FileStamp>& stamps) {
  return std::ranges::all_of(stamps, [](const FileStamp& stamp) { return stampOf(stamp.path) == stamp; });
}

}  // namespace sundial
