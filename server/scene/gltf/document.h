// From JSON text to a checked document.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "result.h"

namespace sundial::gltf {

struct Buffer {
  std::optional<std::string> uri;  // none: the GLB's binary chunk, or a fallback that is never read
  std::uint64_t byteLength = 0;
};

// EXT_meshopt_compression: where the compressed bytes are and what they decode to.
struct MeshoptView {
  std::size_t buffer = 0;
  std::uint64_t byteOffset = 0, byteLength = 0, byteStride = 0, count = 0;
  std::string mode, filter;
};

struct BufferView {
  std::size_t buffer = 0;
  std::uint64_t byteOffset = 0, byteLength = 0;
  std::uint64_t byteStride = 0;  // 0: elements are packed
  std::optional<MeshoptView> meshopt;
};

struct Image {
  std::string name, mimeType;
  std::optional<std::string> uri;
  std::optional<std::size_t> bufferView;
};

// Every index is in range and every number finite. tinygltf's model holds the structure; its buffers, buffer
// views and images are empty shells, because tinygltf 2.7 copies every byte, reads images that nothing uses,
// and refuses a buffer without data, which is what meshopt's fallback is.
struct Document {
  tinygltf::Model model;
  std::vector<Buffer> buffers;
  std::vector<BufferView> bufferViews;
  std::vector<Image> images;
};

// Reads no file. `maxBytes` bounds the memory that the document may take. Errors: dataLoss for text cut off,
// resourceExhausted, invalidArgument, naming the element.
Result<Document> parseDocument(std::string_view text, std::uint64_t maxBytes);

}  // namespace sundial::gltf
