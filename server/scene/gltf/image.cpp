#include "scene/gltf/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>

namespace sundial::gltf {

namespace {

constexpr unsigned kMaxSide = 16384;

std::uint32_t bigEndian(Bytes bytes, std::size_t offset, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value = value << 8 | std::to_integer<std::uint32_t>(bytes[offset + i]);
  return value;
}

std::unexpected<Error> cutOff() {
  return fail(ErrorCode::dataLoss, "the image is cut off in its header: export the file again");
}

Result<glm::uvec2> pngSize(Bytes bytes) {
  if (bytes.size() < 24) return cutOff();
  return glm::uvec2(bigEndian(bytes, 16, 4), bigEndian(bytes, 20, 4));
}

// Walks the segments up to the frame header.
Result<glm::uvec2> jpegSize(Bytes bytes) {
  std::size_t offset = 2;
  while (offset + 9 <= bytes.size()) {
    const std::uint32_t marker = bigEndian(bytes, offset, 2);
    if (marker == 0xffff) {  // padding
      ++offset;
      continue;
    }
    const bool isFrame =
        marker >= 0xffc0 && marker <= 0xffcf && marker != 0xffc4 && marker != 0xffc8 && marker != 0xffcc;
    if (isFrame) return glm::uvec2(bigEndian(bytes, offset + 7, 2), bigEndian(bytes, offset + 5, 2));
    offset += 2 + bigEndian(bytes, offset + 2, 2);
  }
  return cutOff();
}

}  // namespace

Result<glm::uvec2> imageSize(Bytes bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Result<glm::uvec2> size;
  if (text.starts_with("\x89PNG\r\n\x1a\n"))
    size = pngSize(bytes);
  else if (text.starts_with("\xff\xd8\xff"))
    size = jpegSize(bytes);
  else if (text.starts_with("\xabKTX"))
    return invalid("the image is KTX, not PNG or JPEG: convert it");
  else if (text.starts_with("RIFF"))
    return invalid("the image is WebP, not PNG or JPEG: convert it");
  else
    return invalid("the image is neither PNG nor JPEG: convert it");
  if (!size) return size;
  if (size->x == 0 || size->y == 0 || size->x > kMaxSide || size->y > kMaxSide)
    return invalid(
        fmt::format("the image is {} x {}, a side must be 1 to {}: scale it", size->x, size->y, kMaxSide));
  return size;
}

Result<Texture> decodeImage(Bytes bytes) {
  const Result<glm::uvec2> size = imageSize(bytes);
  if (!size) return std::unexpected(size.error());
  tinygltf::Image image;
  std::string error, warning;
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) ||
      !tinygltf::LoadImageData(
          &image, 0, &error, &warning, static_cast<int>(size->x), static_cast<int>(size->y),
          reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()), nullptr))
    return fail(ErrorCode::dataLoss, "the image does not decode: it is damaged, export the file again");

  const std::size_t depth = image.bits == 16 ? 2 : 1;
  const std::size_t texels = std::size_t{size->x} * size->y;
  if (image.component != 4 || image.image.size() < texels * 4 * depth)
    return fail(ErrorCode::dataLoss, "the image decodes to another size than its header says");
  Texture texture{*size, std::vector<glm::u8vec4>(texels)};
  for (std::size_t i = 0; i < texels; ++i)
    for (std::size_t c = 0; c < 4; ++c)  // of 16 bits the upper eight, little-endian
      texture.texels[i][static_cast<int>(c)] = image.image[(i * 4 + c) * depth + depth - 1];
  return texture;
}

}  // namespace sundial::gltf
