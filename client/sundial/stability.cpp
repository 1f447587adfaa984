#include "sundial/stability.h"

#include <fmt/format.h>

#include <span>

#include "sundial/crc32c.h"

namespace sundial::client {
namespace {

grpc::Status lost(std::string_view why) {
  return {grpc::DATA_LOSS, fmt::format("the server's stream is damaged: {}; ask again", why)};
}

}  // namespace

StabilityAssembler::StabilityAssembler(const v1::StabilityRequest& request)
    : stability_{.accepted = {}, .methods = std::vector<MethodStability>(request.methods().size())},
      width_(request.width()),
      height_(request.height()) {}

grpc::Status StabilityAssembler::add(v1::StabilityEvent event) {
  using Event = v1::StabilityEvent;
  if (done_) return lost("an event follows the end");
  if (event.event_case() != Event::kAccepted && !accepted_) return lost("it doesn't begin at its start");
  if (open_ && event.event_case() != Event::kImageChunk && event.event_case() != Event::kImageEnd)
    return lost("a picture doesn't end");
  switch (event.event_case()) {
    case Event::kAccepted:
      if (accepted_) return lost("it begins twice");
      accepted_ = true;
      stability_.accepted = std::move(*event.mutable_accepted());
      return grpc::Status::OK;
    case Event::kFrame:
      frames_ = static_cast<double>(stability_.methods.size()) * event.frame().frames();
      ++framesDone_;
      return grpc::Status::OK;
    case Event::kPictureBegin:
      return begin(std::move(*event.mutable_picture_begin()));
    case Event::kImageChunk:
      if (!open_) return lost("a piece of no picture");
      if (open_->rgba.size() + event.image_chunk().data().size() > open_->about.bytes())
        return lost("a picture has too many bytes");
      open_->rgba += event.image_chunk().data();
      return grpc::Status::OK;
    case Event::kImageEnd:
      return end(event.image_end());
    case Event::kOutcome: {
      if (event.outcome().method() >= stability_.methods.size())
        return lost("a result that wasn't asked for");
      v1::StabilityResult& result = stability_.methods[event.outcome().method()].result;
      if (!result.method().empty()) return lost("a result comes twice");
      result = std::move(*event.mutable_outcome()->mutable_result());
      return grpc::Status::OK;
    }
    case Event::kDone:
      done_ = true;
      return grpc::Status::OK;
    case Event::EVENT_NOT_SET:
      return grpc::Status::OK;  // of a newer server
  }
  return lost("an unknown event");
}

grpc::Status StabilityAssembler::begin(v1::PictureBegin about) {
  if (about.method() >= stability_.methods.size()) return lost("a picture that wasn't asked for");
  if (about.width() != width_ || about.height() != height_ ||
      about.bytes() != std::uint64_t{width_} * height_ * 4)
    return lost(fmt::format("a picture is {}x{} in {} bytes", about.width(), about.height(), about.bytes()));
  auto& pictures = stability_.methods[about.method()].pictures;
  open_ = &pictures.emplace_back(StabilityPicture{std::move(about), {}});
  open_->rgba.reserve(open_->about.bytes());
  return grpc::Status::OK;
}

grpc::Status StabilityAssembler::end(const v1::ImageEnd& end) {
  if (!open_) return lost("an end of no picture");
  if (open_->rgba.size() != open_->about.bytes()) return lost("a picture has too few bytes");
  if (crc32c(std::as_bytes(std::span(open_->rgba))) != end.crc32c())
    return lost("a picture's checksum is wrong");
  open_ = nullptr;
  return grpc::Status::OK;
}

Expected<Stability> StabilityAssembler::finish() {
  if (!done_) return fail(lost("it stops before its end"));
  for (const MethodStability& method : stability_.methods)
    if (method.result.method().empty()) return fail(lost("a method's result is missing"));
  return std::move(stability_);
}

}  // namespace sundial::client
