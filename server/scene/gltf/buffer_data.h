// The bytes behind buffer views, fetched and decompressed when first asked for.
#pragma once

#include <deque>
#include <span>

#include "scene/gltf/container.h"
#include "scene/gltf/document.h"
#include "scene/load.h"

namespace sundial::gltf {

using Bytes = std::span<const std::byte>;

// What decoding may still take of a scene's limit.
class Budget {
 public:
  explicit Budget(std::uint64_t bytes) : left_(bytes), limit_(bytes) {}
  // Call before allocating. Error: resourceExhausted, naming the limit.
  Result<void> spend(std::uint64_t count, std::uint64_t bytesEach);

 private:
  std::uint64_t left_, limit_;
};

// Keeps references to its arguments; spans live as long as it does. Not for several threads.
class BufferData {
 public:
  BufferData(const Document&, const Container&, const SceneFiles&, Budget&);

  // Errors: notFound for a file that was not given, dataLoss for a buffer cut off, invalidArgument, each
  // naming the element.
  Result<Bytes> bufferView(std::size_t index);
  Result<Bytes> image(std::size_t index);
  Result<Bytes> slice(std::size_t buffer, std::uint64_t offset, std::uint64_t length);

 private:
  Result<Bytes> buffer(std::size_t index);
  Result<Bytes> resource(const std::string& uri);

  const Document& document_;
  const Container& container_;
  const SceneFiles& files_;
  Budget& budget_;
  std::vector<std::optional<Bytes>> buffers_, views_;
  std::deque<std::string> owned_;  // of data URIs
  std::deque<std::vector<std::byte>> decoded_;
};

}  // namespace sundial::gltf
