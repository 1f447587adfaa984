#include "sundial/rendering.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "sundial/crc32c.h"

namespace sundial::client {
namespace {

grpc::Status lost(std::string_view why) {
  return {grpc::DATA_LOSS, fmt::format("the server's stream is damaged: {}; render again", why)};
}

}  // namespace

std::string_view aovName(v1::Aov aov) {
  switch (aov) {
    case v1::COLOUR:
      return "colour";
    case v1::VISIBILITY:
      return "visibility";
    case v1::REFERENCE:
      return "reference";
    case v1::POSITION:
      return "position";
    case v1::NORMAL:
      return "normal";
    case v1::ID:
      return "id";
    case v1::VIEW:
      return "view";
    case v1::CLASS:
      return "class";
    default:
      return "unknown";
  }
}

std::size_t bytesPerPixel(v1::Aov aov) {
  switch (aov) {
    case v1::COLOUR:
    case v1::VISIBILITY:
    case v1::REFERENCE:
    case v1::VIEW:
    case v1::CLASS:
      return 4;
    case v1::ID:
      return 8;
    case v1::POSITION:
    case v1::NORMAL:
      return 12;
    default:
      return 0;
  }
}

const Image* MethodRendering::find(v1::Aov aov) const {
  const auto found = std::ranges::find(images, aov, &Image::aov);
  return found == images.end() ? nullptr : &*found;
}

RenderingAssembler::RenderingAssembler(const v1::RenderRequest& request) : request_(request) {
  rendering_.methods.resize(static_cast<std::size_t>(request.methods_size()));
}

grpc::Status RenderingAssembler::add(v1::RenderEvent event) {
  const auto known = [&](unsigned method) { return method < rendering_.methods.size(); };
  if (done_) return lost("an event follows the end");
  if (event.event_case() != v1::RenderEvent::kAccepted && !accepted_)
    return lost("it doesn't begin at its start");
  if (open_ && event.event_case() != v1::RenderEvent::kImageChunk &&
      event.event_case() != v1::RenderEvent::kImageEnd)
    return lost("an image doesn't end");
  switch (event.event_case()) {
    case v1::RenderEvent::kAccepted:
      if (accepted_) return lost("it begins twice");
      accepted_ = true;
      rendering_.accepted = std::move(*event.mutable_accepted());
      return grpc::Status::OK;
    case v1::RenderEvent::kLayout:
      if (!known(event.layout().method())) return lost("a plan of a method that wasn't asked for");
      rendering_.methods[event.layout().method()].plan = std::move(*event.mutable_layout()->mutable_plan());
      return grpc::Status::OK;
    case v1::RenderEvent::kImageBegin:
      return begin(event.image_begin());
    case v1::RenderEvent::kImageChunk:
      return append(event.image_chunk());
    case v1::RenderEvent::kImageEnd:
      return end(event.image_end());
    case v1::RenderEvent::kTimings: {
      if (!known(event.timings().method())) return lost("times of a method that wasn't asked for");
      v1::Result& result = rendering_.methods[event.timings().method()].result;
      if (!result.method().empty()) return lost("times of a method come twice");
      result = std::move(*event.mutable_timings()->mutable_result());
      ++methodsDone_;
      return grpc::Status::OK;
    }
    case v1::RenderEvent::kDone:
      done_ = true;
      return grpc::Status::OK;
    case v1::RenderEvent::EVENT_NOT_SET:
      return grpc::Status::OK;  // of a newer server
  }
  return lost("an unknown event");
}

grpc::Status RenderingAssembler::begin(const v1::ImageBegin& image) {
  const std::uint64_t bytes =
      std::uint64_t{request_.width()} * request_.height() * bytesPerPixel(image.aov());
  if (image.method() >= rendering_.methods.size() ||
      std::ranges::find(request_.images(), static_cast<int>(image.aov())) == request_.images().end())
    return lost("an image that wasn't asked for");
  if (image.width() != request_.width() || image.height() != request_.height() || image.bytes() != bytes)
    return lost(fmt::format("the {} image is {}x{} in {} bytes, not {}x{} in {}", aovName(image.aov()),
                            image.width(), image.height(), image.bytes(), request_.width(), request_.height(),
                            bytes));
  MethodRendering& method = rendering_.methods[image.method()];
  if (method.find(image.aov())) return lost("an image comes twice");
  method.images.push_back({image.aov(), image.width(), image.height(), {}});
  method.images.back().bytes.reserve(bytes);
  openBytes_ = bytes;
  open_ = &method;
  return grpc::Status::OK;
}

grpc::Status RenderingAssembler::append(const v1::ImageChunk& chunk) {
  if (!open_) return lost("a piece of no image");
  std::string& bytes = open_->images.back().bytes;
  if (bytes.size() + chunk.data().size() > openBytes_) return lost("an image has too many bytes");
  bytes += chunk.data();
  received_ += chunk.data().size();
  return grpc::Status::OK;
}

grpc::Status RenderingAssembler::end(const v1::ImageEnd& end) {
  if (!open_) return lost("an end of no image");
  const Image& image = open_->images.back();
  if (image.bytes.size() != openBytes_)
    return lost(
        fmt::format("the {} image has {} of {} bytes", aovName(image.aov), image.bytes.size(), openBytes_));
  if (sundial::crc32c(std::as_bytes(std::span(image.bytes))) != end.crc32c())
    return lost(fmt::format("the {} image's checksum is wrong", aovName(image.aov)));
  open_ = nullptr;
  return grpc::Status::OK;
}

Expected<Rendering> RenderingAssembler::finish() {
  if (!done_) return fail(lost("it stops before its end"));
  for (MethodRendering& method : rendering_.methods) {
    if (method.result.method().empty()) return fail(lost("a method's times are missing"));
    std::vector<Image> ordered;
    for (const int number : request_.images()) {
      const auto aov = static_cast<v1::Aov>(number);
      const auto found = std::ranges::find(method.images, aov, &Image::aov);
      if (found == method.images.end())
        return fail(lost(fmt::format("the {} image is missing", aovName(aov))));
      ordered.push_back(std::move(*found));
    }
    method.images = std::move(ordered);
  }
  return std::move(rendering_);
}

}  // namespace sundial::client
