// A stability run put together from the events of its stream, believed only when it is whole.
#pragma once

#include <string>
#include <vector>

#include "sundial/error.h"
#include "sundial/v1/sundial.pb.h"

namespace sundial::client {

struct StabilityPicture {
  v1::PictureBegin about;  // frame, size, flipped points
  std::string rgba;        // width * height * 4 bytes, sRGB, row 0 at the top
};

struct MethodStability {
  v1::StabilityResult result;
  std::vector<StabilityPicture> pictures;  // by frame
};

struct Stability {
  v1::Accepted accepted;                 // view and light are those of the first frame
  std::vector<MethodStability> methods;  // as in StabilityRequest.methods
};

// Takes a stream's events in order and refuses, with DATA_LOSS, whatever the contract doesn't promise.
class StabilityAssembler {
 public:
  explicit StabilityAssembler(const v1::StabilityRequest&);

  grpc::Status add(v1::StabilityEvent);

  // Call after the stream ended well. The assembler is spent.
  Expected<Stability> finish();

  // Frames of all methods that are done, and how many there are; 0 of 0 before the first.
  double framesDone() const { return framesDone_; }
  double frames() const { return frames_; }

 private:
  grpc::Status begin(v1::PictureBegin);
  grpc::Status end(const v1::ImageEnd&);

  Stability stability_;
  const std::uint32_t width_, height_;
  StabilityPicture* open_ = nullptr;  // that is being received
  double framesDone_ = 0, frames_ = 0;
  bool accepted_ = false, done_ = false;
};

}  // namespace sundial::client
