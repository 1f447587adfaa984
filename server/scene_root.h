// The folder of scenes that a server offers, and nothing outside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "result.h"
#include "scene/load.h"

namespace sundial {

// What tells that a file on disk has changed.
struct FileStamp {
  std::filesystem::path path;
  std::filesystem::file_time_type time;
  std::uintmax_t size = 0;
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

class SceneRoot {
 public:
  // Errors: invalidArgument for what is no folder.
  static Result<SceneRoot> open(const std::filesystem::path&);

  // A .glb or .gltf by its path relative to the root. Errors: notFound, naming what there is; invalidArgument
  // for a path that leads out of the root, by itself or by a symbolic link.
  Result<std::filesystem::path> resolve(std::string_view name) const;

  // Relative paths of all .glb and .gltf files, sorted; at most `limit`.
  std::vector<std::string> list(std::size_t limit = 10'000) const;

 private:
  explicit SceneRoot(std::filesystem::path canonical) : root_(std::move(canonical)) {}
  bool contains(const std::filesystem::path& canonical) const;
  std::filesystem::path root_;
};

// Stamps of a scene's files, given the main file's path and when reading them began; nothing if one can't be
// told or a file may have changed since.
std::optional<std::vector<FileStamp>> stampsOf(const std::filesystem::path& main, const SceneFiles&,
                                               std::filesystem::file_time_type readBegan);
bool unchanged(const std::vector<FileStamp>&);

}  // namespace sundial
