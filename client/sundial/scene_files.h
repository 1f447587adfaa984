// The files that make up a local glTF scene: the main one and what it refers to beside itself.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sundial/error.h"

namespace sundial::client {

struct SceneFile {
  std::string uri;  // as the main file writes it
  std::filesystem::path path;
};

struct SceneFiles {
  std::vector<SceneFile> files;  // the main file first
  std::uint64_t bytes = 0;       // of all of them
};

// Reads a .gltf, or the JSON part of a .glb, for the URIs of its buffers and images. What isn't glTF is
// listed alone: the server says what is wrong with it. Errors: NOT_FOUND for an unreadable file, naming it;
// INVALID_ARGUMENT for a URI that leaves the scene's folder.
Expected<SceneFiles> gatherSceneFiles(const std::filesystem::path& main);

// SceneInfo.digest of these files, before any server has them. Errors: NOT_FOUND for one that can't be read.
Expected<std::string> digestOf(const SceneFiles&);

}  // namespace sundial::client
