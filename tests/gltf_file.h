// Writes small glTF files, whole or broken, for tests.
#pragma once

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/load.h"

namespace sundial {

enum ComponentType {
  kByte = 5120,
  kUbyte = 5121,
  kShort = 5122,
  kUshort = 5123,
  kUint = 5125,
  kFloat = 5126
};

template <class T>
std::string bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// A document with one scene; `json` is there to be changed at will.
class GltfFile {
 public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}},
                         {"scene", 0},
                         {"scenes", {{{"nodes", nlohmann::json::array()}}}},
                         {"nodes", nlohmann::json::array()},
                         {"meshes", nlohmann::json::array()},
                         {"accessors", nlohmann::json::array()},
                         {"bufferViews", nlohmann::json::array()}};

  std::size_t addView(const std::string& bytes) {
    binary_.resize((binary_.size() + 3) / 4 * 4);
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
    binary_ += bytes;
    return json["bufferViews"].size() - 1;
  }
  template <class T>
  std::size_t addAccessor(const std::vector<T>& values, const std::string& type, std::size_t components,
                          ComponentType componentType, bool normalized = false) {
    json["accessors"].push_back({{"bufferView", addView(bytesOf(values))},
                                 {"componentType", componentType},
                                 {"normalized", normalized},
                                 {"count", values.size() / components},
                                 {"type", type}});
    return json["accessors"].size() - 1;
  }
  // A mesh of one primitive.
  std::size_t addMesh(nlohmann::json primitive) {
    json["meshes"].push_back({{"name", "mesh"}, {"primitives", {std::move(primitive)}}});
    return json["meshes"].size() - 1;
  }
  std::size_t addRoot(nlohmann::json node) {
    json["nodes"].push_back(std::move(node));
    json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
    return json["nodes"].size() - 1;
  }

  const std::string& binary() const { return binary_; }

  std::string glb() const {
    nlohmann::json document = json;
    if (!document.contains("buffers") && !binary_.empty())
      document["buffers"] = {{{"byteLength", binary_.size()}}};
    std::string text = document.dump(), binary = binary_;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4);
    std::string bytes =
        "glTF" + word(2) + word(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
    bytes += word(text.size()) + "JSON" + text;
    if (!binary.empty()) bytes += word(binary.size()) + std::string("BIN\0", 4) + binary;
    return bytes;
  }
  SceneFiles files() const { return {.main = "test.glb", .files = {{"test.glb", glb()}}}; }

 private:
  static std::string word(std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
    return bytes;
  }
  std::string binary_;
};

// Two triangles, the square from (0, 0) to (1, 1) in z = 0, with texture coordinates.
inline GltfFile squareFile() {
  GltfFile file;
  const std::size_t positions =
      file.addAccessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3, kFloat);
  const std::size_t uvs = file.addAccessor(std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}, "VEC2", 2, kFloat);
  const std::size_t indices =
      file.addAccessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1, kUshort);
  file.addMesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}, {"indices", indices}});
  file.addRoot({{"name", "square"}, {"mesh", 0}});
  return file;
}

// An RGBA PNG without compression. `texels`: 4 bytes each, row 0 first.
inline std::string png(unsigned width, unsigned height, const std::string& texels) {
  const auto big = [](std::uint32_t v) {
    std::string s;
    for (int shift = 24; shift >= 0; shift -= 8) s.push_back(static_cast<char>(v >> shift & 0xff));
    return s;
  };
  const auto chunk = [&](const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xffffffffu;
    for (const char c : type + data) {
      crc ^= static_cast<unsigned char>(c);
      for (int k = 0; k < 8; ++k) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return big(static_cast<std::uint32_t>(data.size())) + type + data + big(~crc);
  };
  std::string rows;
  for (unsigned y = 0; y < height; ++y)
    rows += std::string(1, '\0') + texels.substr(y * width * 4, width * 4);
  std::uint32_t a = 1, b = 0;
  for (const char c : rows) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto length = static_cast<unsigned>(rows.size());
  std::string zlib = "\x78\x01\x01";
  for (const unsigned v : {length & 0xffu, length >> 8u, ~length & 0xffu, ~length >> 8u & 0xffu})
    zlib.push_back(static_cast<char>(v));
  zlib += rows + big(b << 16 | a);
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", big(width) + big(height) + std::string("\x08\x06\0\0\0", 5)) +
         chunk("IDAT", zlib) + chunk("IEND", "");
}

}  // namespace sundial
