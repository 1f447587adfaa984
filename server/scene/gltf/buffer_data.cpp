#include "scene/gltf/buffer_data.h"

#include <fmt/format.h>

#include "scene/gltf/meshopt.h"
#include "scene/gltf/uri.h"
#include "scene/quoted_name.h"

namespace sundial::gltf {

namespace {
Bytes bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

std::unexpected<Error> at(std::string_view section, std::size_t index, const Error& error) {
  return fail(error.code, fmt::format("{}[{}]: {}", section, index, error.message));
}
}  // namespace

Result<void> Budget::spend(std::uint64_t count, std::uint64_t bytesEach) {
  if (count > left_ / bytesEach)
    return fail(
        ErrorCode::resourceExhausted,
        fmt::format("{} elements of {} bytes go beyond the limit of {} bytes a scene: split the scene "
                    "or raise the server's limit",
                    count, bytesEach, limit_));
  left_ -= count * bytesEach;
  return {};
}

BufferData::BufferData(const Document& document, const Container& container, const SceneFiles& files,
                       Budget& budget)
    : document_(document),
      container_(container),
      files_(files),
      budget_(budget),
      buffers_(document.buffers.size()),
      views_(document.bufferViews.size()) {}

Result<Bytes> BufferData::resource(const std::string& uri) {
  if (isDataUri(uri)) {
    if (auto ok = budget_.spend(uri.size(), 1); !ok) return std::unexpected(ok.error());
    Result<std::string> bytes = decodeDataUri(uri);
    if (!bytes) return std::unexpected(bytes.error());
    return bytesOf(owned_.emplace_back(std::move(*bytes)));
  }
  auto file = files_.files.find(uri);
  if (file == files_.files.end()) file = files_.files.find(percentDecode(uri));
  if (file == files_.files.end())
    return fail(ErrorCode::notFound,
                fmt::format("the file {} is missing: put it beside the scene, or pack both into one .glb",
                            quotedName(uri)));
  return bytesOf(file->second);
}

Result<Bytes> BufferData::buffer(std::size_t index) {
  if (buffers_[index]) return *buffers_[index];
  const Buffer& buffer = document_.buffers[index];
  Result<Bytes> bytes;
  if (buffer.uri)
    bytes = resource(*buffer.uri);
  else if (index == 0 && container_.binary)
    bytes = bytesOf(*container_.binary);
  else
    return invalid(
        fmt::format("buffers[{}] has no URI and there is no binary chunk for it: export the file "
                    "again",
                    index));
  if (!bytes) return at("buffers", index, bytes.error());
  if (bytes->size() < buffer.byteLength)
    return fail(ErrorCode::dataLoss,
                fmt::format("buffers[{}] is cut off: {} of {} bytes are there; copy or export the file again",
                            index, bytes->size(), buffer.byteLength));
  buffers_[index] = bytes->first(buffer.byteLength);
  return *buffers_[index];
}

Result<Bytes> BufferData::slice(std::size_t bufferIndex, std::uint64_t offset, std::uint64_t length) {
  const Result<Bytes> bytes = buffer(bufferIndex);
  if (!bytes) return bytes;
  if (offset > bytes->size() || length > bytes->size() - offset)
    return invalid(fmt::format(
        "bytes {} to {} of buffers[{}], which has {}: the file is damaged or was exported wrongly", offset,
        offset + length, bufferIndex, bytes->size()));
  return bytes->subspan(offset, length);
}

Result<Bytes> BufferData::bufferView(std::size_t index) {
  if (views_[index]) return *views_[index];
  const BufferView& view = document_.bufferViews[index];
  if (!view.meshopt) {
    const Result<Bytes> bytes = slice(view.buffer, view.byteOffset, view.byteLength);
    if (!bytes) return at("bufferViews", index, bytes.error());
    views_[index] = *bytes;
    return *bytes;
  }
  const Result<Bytes> compressed =
      slice(view.meshopt->buffer, view.meshopt->byteOffset, view.meshopt->byteLength);
  if (!compressed) return at("bufferViews", index, compressed.error());
  Result<std::vector<std::byte>> decoded = decodeMeshopt(*view.meshopt, *compressed, budget_);
  if (!decoded) return at("bufferViews", index, decoded.error());
  views_[index] = decoded_.emplace_back(std::move(*decoded));
  return *views_[index];
}

Result<Bytes> BufferData::image(std::size_t index) {
  const Image& image = document_.images[index];
  if (!image.uri && !image.bufferView)
    return invalid(
        fmt::format("images[{}] has neither a URI nor a buffer view: export the file again", index));
  const Result<Bytes> bytes = image.bufferView ? bufferView(*image.bufferView) : resource(*image.uri);
  if (!bytes) return at("images", index, bytes.error());
  return bytes;
}

}  // namespace sundial::gltf
