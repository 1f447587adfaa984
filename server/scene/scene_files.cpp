#include <fmt/format.h>

#include <fstream>

#include "scene/gltf/container.h"
#include "scene/gltf/document.h"
#include "scene/gltf/uri.h"
#include "scene/load.h"
#include "scene/quoted_name.h"

namespace sundial {

namespace {

namespace fs = std::filesystem;

// Reads a regular file of at most `maxBytes`.
Result<std::string> readFile(const fs::path& path, std::uint64_t maxBytes) {
  std::error_code error;
  if (!fs::is_regular_file(path, error))
    return fail(ErrorCode::notFound,
                fmt::format("{} is not there or is no file: check the path", quotedName(path.string())));
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > maxBytes)
    return fail(ErrorCode::resourceExhausted,
                fmt::format("{} brings the scene over the limit of bytes: it has {}, {} are left; split the "
                            "scene or raise the server's limit",
                            quotedName(path.string()), size, maxBytes));
  std::ifstream file(path, std::ios::binary);
  std::string bytes(error ? 0 : size, '\0');
  if (error || !file || !file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    return fail(ErrorCode::notFound,
                fmt::format("{} can't be read: check its permissions", quotedName(path.string())));
  return bytes;
}

std::vector<std::string> uris(const gltf::Document& document) {
  std::vector<std::string> result;
  for (const gltf::Buffer& buffer : document.buffers)
    if (buffer.uri) result.push_back(*buffer.uri);
  for (const gltf::Image& image : document.images)
    if (image.uri) result.push_back(*image.uri);
  std::erase_if(result, [](const std::string& uri) { return gltf::isDataUri(uri); });
  return result;
}

}  // namespace

Result<SceneFiles> readSceneFiles(const fs::path& path, const SceneLimits& limits) {
  Result<std::string> main = readFile(path, limits.maxFileBytes);
  if (!main) return std::unexpected(main.error());
  SceneFiles scene{.main = path.filename().string(), .files = {}};
  std::uint64_t left = limits.maxFileBytes - main->size();
  const auto named = [&](const Error& error) {
    return fail(error.code, fmt::format("{}: {}", quotedName(scene.main), error.message));
  };

  const Result<gltf::Container> container = gltf::openContainer(*main);
  if (!container) return named(container.error());
  const Result<gltf::Document> document = gltf::parseDocument(container->json, limits.maxDecodedBytes);
  if (!document) return named(document.error());
  for (const std::string& uri : uris(*document)) {
    if (scene.files.contains(uri)) continue;
    const std::string relative = gltf::percentDecode(uri);
    if (!gltf::staysInFolder(relative))
      return named({ErrorCode::invalidArgument,
                    fmt::format("the URI {} is not a relative path inside the scene's folder: put the file "
                                "beside the scene",
                                quotedName(uri))});
    // An image that nothing uses may be missing; what is used is missed when the scene is parsed.
    std::error_code error;
    if (!fs::exists(path.parent_path() / relative, error)) continue;
    Result<std::string> bytes = readFile(path.parent_path() / relative, left);
    if (!bytes) return named(bytes.error());
    left -= bytes->size();
    scene.files[uri] = std::move(*bytes);
  }
  scene.files[scene.main] = std::move(*main);
  return scene;
}

}  // namespace sundial
