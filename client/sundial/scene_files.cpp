#include "sundial/scene_files.h"

#include <fmt/format.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "sundial/content_digest.h"

namespace sundial::client {
namespace {

namespace fs = std::filesystem;

std::uint32_t littleEndian(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// The JSON of either kind of file; nothing if a .glb's header is damaged.
std::optional<std::string> readJson(std::ifstream& file, std::uint64_t size) {
  std::array<char, 20> header{};  // magic, version, length; the first chunk's length and type
  if (size >= header.size() && file.read(header.data(), header.size()) &&
      std::string_view(header.data(), 4) == "glTF") {
    const std::uint32_t length = littleEndian(&header[12]);
    if (std::string_view(&header[16], 4) != "JSON" || length > size - header.size()) return std::nullopt;
    size = length;
  } else {
    file.clear();
    file.seekg(0);
  }
  std::string json(size, '\0');
  if (!file.read(json.data(), static_cast<std::streamsize>(size))) return std::nullopt;
  return json;
}

std::string percentDecoded(std::string_view uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned value = 0;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(&uri[i + 1], &uri[i + 1] + 2, value, 16).ptr == &uri[i + 1] + 2) {
      path += static_cast<char>(value);
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

// Each once, in the file's order, without data: URIs.
std::vector<std::string> externalUris(const google::protobuf::Struct& document) {
  std::vector<std::string> uris;
  std::set<std::string> seen;
  for (const char* list : {"buffers", "images"}) {
    const auto found = document.fields().find(list);
    if (found == document.fields().end()) continue;
    for (const auto& item : found->second.list_value().values()) {
      const auto uri = item.struct_value().fields().find("uri");
      if (uri == item.struct_value().fields().end()) continue;
      const std::string& text = uri->second.string_value();
      if (!text.empty() && !text.starts_with("data:") && seen.insert(text).second) uris.push_back(text);
    }
  }
  return uris;
}

Expected<void> add(SceneFiles& scene, std::string uri, const fs::path& path) {
  const auto unreadable = [&](const std::string& why) {
    return fail(grpc::NOT_FOUND, fmt::format("can't read {}: {}; check the path", path.string(), why));
  };
  std::error_code error;
  if (fs::is_directory(path, error)) return unreadable("it is a folder");
  if (!std::ifstream(path, std::ios::binary)) return unreadable(std::strerror(errno));
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) return unreadable(error.message());
  scene.bytes += size;
  scene.files.push_back({std::move(uri), path});
  return {};
}

Expected<void> addContent(ContentDigest& digest, const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  std::string piece(1 << 20, '\0');
  std::uintmax_t done = 0;
  if (!error) digest.begin(size);
  while (file && !error && done < size) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    const auto count = static_cast<std::size_t>(file.gcount());
    digest.update(std::string_view(piece).substr(0, count));
    done += count;
  }
  if (error || done != size)
    return fail(grpc::NOT_FOUND, fmt::format("can't read {}; check the path", path.string()));
  return {};
}

}  // namespace

Expected<SceneFiles> gatherSceneFiles(const fs::path& main) {
  SceneFiles scene;
  if (auto added = add(scene, main.filename().string(), main); !added) return std::unexpected(added.error());

  std::ifstream file(main, std::ios::binary);
  const auto json = readJson(file, scene.bytes);
  google::protobuf::Struct document;
  if (!json || !google::protobuf::util::JsonStringToMessage(*json, &document).ok()) return scene;

  for (const std::string& uri : externalUris(document)) {
    const fs::path relative = fs::path(percentDecoded(uri)).lexically_normal();
    if (relative.is_absolute() || *relative.begin() == ".." || uri.contains("://") || uri.contains('\\'))
      return fail(
          grpc::INVALID_ARGUMENT,
          fmt::format("{} refers to '{}' outside its folder; move the file beside it and correct the URI",
                      main.string(), uri));
    if (auto added = add(scene, uri, main.parent_path() / relative); !added)
      return std::unexpected(added.error());
  }
  return scene;
}

Expected<std::string> digestOf(const SceneFiles& scene) {
  ContentDigest digest;
  digest.add("files");
  if (auto added = addContent(digest, scene.files.front().path); !added)
    return std::unexpected(added.error());
  std::map<std::string, fs::path> others;
  for (std::size_t i = 1; i < scene.files.size(); ++i) others[scene.files[i].uri] = scene.files[i].path;
  others.erase(scene.files.front().uri);
  for (const auto& [uri, path] : others) {
    digest.add(uri);
    if (auto added = addContent(digest, path); !added) return std::unexpected(added.error());
  }
  return digest.hexadecimal();
}

}  // namespace sundial::client
