#include "scene/gltf/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scene/gltf/extensions.h"
#include "scene/gltf/schema.h"
#include "scene/quoted_name.h"

namespace sundial::gltf {

namespace {

using nlohmann::json;

// Deeper than any glTF that is read here; what recurses over the document stays within the stack.
constexpr int kMaxDepth = 64;
// What a value costs in nlohmann's tree, in tinygltf's copy and in its model, roughly.
constexpr std::uint64_t kBytesPerValue = 128;

// How deep and how large JSON text is, before it is believed to be JSON. nlohmann's own callback would tell
// too, but searches the whole parent at each child's end: quadratic in the number of nodes.
struct Extent {
  int depth = 0;
  std::uint64_t values = 1;
};

Extent measure(std::string_view text) {
  Extent extent;
  int depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      inString = c != '"';
      continue;
    }
    inString = c == '"';
    if (c == '{' || c == '[') extent.depth = std::max(extent.depth, ++depth);
    if (c == '}' || c == ']') --depth;
    extent.values += c == '{' || c == '[' || c == ',' || c == ':';
  }
  return extent;
}

Result<json> parseJson(std::string_view text, std::uint64_t maxBytes) {
  const Extent extent = measure(text);
  if (extent.depth > kMaxDepth)
    return invalid(fmt::format("the JSON is nested deeper than {} levels: no glTF needs that", kMaxDepth));
  if (extent.values > maxBytes / kBytesPerValue)
    return fail(ErrorCode::resourceExhausted,
                fmt::format("the JSON has {} values, too many for the limit of {} bytes a scene: split the "
                            "scene or raise the server's limit",
                            extent.values, maxBytes));
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::parse_error& e) {
    if (e.byte > text.size())
      return fail(
          ErrorCode::dataLoss,
          fmt::format("the JSON is cut off after {} bytes: copy or export the file again", text.size()));
    return invalid(fmt::format("the JSON is malformed near byte {}: export the file again", e.byte));
  } catch (const json::exception&) {
    return invalid("the JSON is malformed, a number in it is out of range: export the file again");
  }
}

Buffer readBuffer(const json& from) {
  Buffer buffer;
  if (from.contains("uri")) buffer.uri = from["uri"].get<std::string>();
  buffer.byteLength = from["byteLength"];
  return buffer;
}

BufferView readBufferView(const json& from) {
  BufferView view{.buffer = from["buffer"],
                  .byteOffset = from.value("byteOffset", std::uint64_t{0}),
                  .byteLength = from["byteLength"],
                  .byteStride = from.value("byteStride", std::uint64_t{0}),
                  .meshopt = {}};
  const json::json_pointer pointer("/extensions/EXT_meshopt_compression");
  if (from.contains(pointer)) {
    const json& meshopt = from[pointer];
    view.meshopt = MeshoptView{.buffer = meshopt["buffer"],
                               .byteOffset = meshopt.value("byteOffset", std::uint64_t{0}),
                               .byteLength = meshopt["byteLength"],
                               .byteStride = meshopt["byteStride"],
                               .count = meshopt["count"],
                               .mode = meshopt["mode"],
                               .filter = meshopt.value("filter", "NONE")};
  }
  return view;
}

Image readImage(const json& from) {
  Image image;
  image.name = from.value("name", "");
  image.mimeType = from.value("mimeType", "");
  if (from.contains("uri")) image.uri = from["uri"].get<std::string>();
  if (from.contains("bufferView")) image.bufferView = from["bufferView"].get<std::size_t>();
  return image;
}

// Moves a section out of the document.
template <class T>
std::vector<T> take(json& document, const char* section, T (*read)(const json&)) {
  std::vector<T> result;
  if (!document.contains(section)) return result;
  result.reserve(document[section].size());
  for (const json& element : document[section]) result.push_back(read(element));
  document.erase(section);
  return result;
}

// Members that tinygltf insists on although nothing here reads them.
void satisfyTinygltf(json& document, std::size_t bufferViews) {
  if (bufferViews > 0) document["bufferViews"] = json(bufferViews, json{{"buffer", 0}, {"byteLength", 1}});
  if (document.contains("cameras"))
    for (json& camera : document["cameras"]) {
      if (camera["type"] == "perspective" && camera.contains("perspective"))
        camera["perspective"]["znear"] = 0.1;
      else
        camera = {{"type", "orthographic"},
                  {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 1}, {"znear", 0}}}};
    }
}

std::string oneLine(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace

Result<Document> parseDocument(std::string_view text, std::uint64_t maxBytes) {
  Result<json> parsed = parseJson(text, maxBytes);
  if (!parsed) return std::unexpected(parsed.error());
  if (auto ok = checkRequiredExtensions(*parsed); !ok) return std::unexpected(ok.error());
  Result<json> reduced = reduceToSchema(*parsed);
  if (!reduced) return std::unexpected(reduced.error());
  *parsed = nullptr;

  if (!reduced->contains("asset"))
    return invalid("asset.version is missing: glTF requires it; give a glTF 2.0 file");
  const std::string version = (*reduced)["asset"]["version"];
  if (!version.starts_with("2."))
    return invalid(
        fmt::format("glTF version {} is not supported: export it as glTF 2.0", quotedName(version)));

  Document document;
  document.buffers = take(*reduced, "buffers", readBuffer);
  document.bufferViews = take(*reduced, "bufferViews", readBufferView);
  document.images = take(*reduced, "images", readImage);
  satisfyTinygltf(*reduced, document.bufferViews.size());

  const std::string plain = reduced->dump();
  *reduced = nullptr;
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({});
  loader.RemoveImageLoader();
  std::string error, warning;
  if (!loader.LoadASCIIFromString(&document.model, &error, &warning, plain.data(),
                                  static_cast<unsigned>(plain.size()), "", tinygltf::NO_REQUIRE))
    return invalid(fmt::format("{}: export the file again", oneLine(error)));
  return document;
}

}  // namespace sundial::gltf
