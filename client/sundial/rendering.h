// A rendering put together from the events of its stream, believed only when it is whole.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sundial/error.h"
#include "sundial/v1/sundial.pb.h"

namespace sundial::client {

// "colour", "visibility", ...: as options and file names write them.
std::string_view aovName(v1::Aov);

// Bytes of a pixel as the contract lays it out.
std::size_t bytesPerPixel(v1::Aov);

struct Image {
  v1::Aov aov = v1::AOV_UNSPECIFIED;
  unsigned width = 0, height = 0;  // pixels
  std::string bytes;               // width * height * bytesPerPixel(aov), row 0 at the top
};

struct MethodRendering {
  v1::Plan plan;
  std::vector<Image> images;  // in the order of RenderRequest.images
  v1::Result result;

  const Image* find(v1::Aov) const;  // null if it wasn't asked for
};

struct Rendering {
  v1::Accepted accepted;
  std::vector<MethodRendering> methods;  // as in RenderRequest.methods
};

// Takes a stream's events in order and refuses, with DATA_LOSS, whatever the contract doesn't promise: an
// image of another size, too few or too many bytes, a wrong checksum, a missing part.
class RenderingAssembler {
 public:
  explicit RenderingAssembler(const v1::RenderRequest&);

  grpc::Status add(v1::RenderEvent);

  // Call after the stream ended well. The assembler is spent.
  Expected<Rendering> finish();

  std::uint64_t bytesReceived() const { return received_; }
  std::uint64_t bytesExpected() const { return rendering_.accepted.bytes_expected(); }
  unsigned methodsDone() const { return methodsDone_; }

 private:
  grpc::Status begin(const v1::ImageBegin&);
  grpc::Status append(const v1::ImageChunk&);
  grpc::Status end(const v1::ImageEnd&);

  const v1::RenderRequest& request_;
  Rendering rendering_;
  MethodRendering* open_ = nullptr;  // whose last image is being received
  std::uint64_t openBytes_ = 0;
  std::uint64_t received_ = 0;
  unsigned methodsDone_ = 0;
  bool accepted_ = false, done_ = false;
};

}  // namespace sundial::client
