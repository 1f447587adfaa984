// Where scenes come from: glTF files (in memory, so that an upload and a disk are alike) and generators.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "result.h"
#include "scene/scene.h"

namespace sundial {

// A glTF or GLB file and the files that it refers to, by the relative URI that it uses.
struct SceneFiles {
  std::string main;                          // key of the .gltf or .glb among `files`
  std::map<std::string, std::string> files;  // bytes
};

struct SceneLimits {
  std::uint64_t maxFileBytes = 2ull << 30;     // all files together
  std::uint64_t maxDecodedBytes = 4ull << 30;  // Scene::bytes()
  std::uint64_t maxTriangles = 50'000'000;     // before instancing
  std::uint64_t maxInstances = 1'000'000;
};

// Reads a file and its siblings. Errors: notFound, resourceExhausted, invalidArgument (a URI that leaves the
// file's folder).
Result<SceneFiles> readSceneFiles(const std::filesystem::path&, const SceneLimits& = {});

// glTF 2.0 as DESIGN section 5 says. Errors: dataLoss for a file cut off, invalidArgument for anything that
// breaks the format, naming the element; never throws, never crashes.
Result<Scene> parseGltf(const SceneFiles&, const SceneLimits& = {});

// "atrium", "trees?count=100&seed=3", ... Errors: notFound names the scenes that there are; invalidArgument
// names the keys and ranges.
Result<Scene> makeBuiltin(std::string_view reference);
struct BuiltinInfo {
  std::string_view name, description;
};
std::vector<BuiltinInfo> builtinScenes();

}  // namespace sundial
