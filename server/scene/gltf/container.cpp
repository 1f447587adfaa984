#include "scene/gltf/container.h"

#include <fmt/format.h>

#include <cstdint>

namespace sundial::gltf {

namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

std::uint32_t littleEndian(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= std::uint32_t{static_cast<unsigned char>(bytes[offset + i])} << (8 * i);
  return value;
}

Result<Container> openGlb(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes)
    return fail(ErrorCode::dataLoss, fmt::format("the file is cut off: its GLB header has {} of {} bytes; "
                                                 "copy or export it again",
                                                 bytes.size(), kHeaderBytes));
  const std::uint32_t version = littleEndian(bytes, 4), length = littleEndian(bytes, 8);
  if (version != 2)
    return invalid(fmt::format("GLB version {} is not supported: export it as glTF 2.0", version));
  if (bytes.size() < length)
    return fail(ErrorCode::dataLoss,
                fmt::format("the file is cut off: {} of {} bytes are there; copy or export it again",
                            bytes.size(), length));
  bytes = bytes.substr(0, length);

  Container container;
  std::size_t offset = kHeaderBytes;
  for (int chunk = 0; offset + kChunkHeaderBytes <= bytes.size(); ++chunk) {
    const std::uint32_t chunkBytes = littleEndian(bytes, offset), type = littleEndian(bytes, offset + 4);
    offset += kChunkHeaderBytes;
    if (chunkBytes > bytes.size() - offset)
      return fail(ErrorCode::dataLoss,
                  fmt::format("the file is damaged: GLB chunk {} has {} bytes, but {} are left; copy or "
                              "export it again",
                              chunk, chunkBytes, bytes.size() - offset));
    if ((type == kJsonChunk) != (chunk == 0))
      return invalid(fmt::format("GLB chunk {} {} JSON: only the first must be; export the file again", chunk,
                                 chunk == 0 ? "is not" : "is"));
    const std::string_view content = bytes.substr(offset, chunkBytes);
    if (type == kJsonChunk) container.json = content;
    if (type == kBinaryChunk && !container.binary) container.binary = content;
    offset += chunkBytes;
    offset += (4 - offset % 4) % 4;
  }
  if (container.json.empty()) return invalid("the GLB has no JSON chunk: export the file again");
  return container;
}

}  // namespace

Result<Container> openContainer(std::string_view bytes) {
  if (bytes.substr(0, kMagic.size()) == kMagic) return openGlb(bytes);
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (bytes.substr(0, kByteOrderMark.size()) == kByteOrderMark) bytes.remove_prefix(kByteOrderMark.size());
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (bytes.empty()) return fail(ErrorCode::dataLoss, "the file is empty: copy or export it again");
  if (!bytes.empty() && kMagic.substr(0, bytes.size()) == bytes)
    return fail(ErrorCode::dataLoss, "the file is cut off in its GLB header: copy or export it again");
  if (start == std::string_view::npos || bytes[start] != '{')
    return invalid("not a glTF file: it begins neither with 'glTF' nor with '{'; give a .glb or a .gltf");
  return Container{.json = bytes, .binary = std::nullopt};
}

}  // namespace sundial::gltf
