#include "service/stability_call.h"

namespace sundial {

StabilityCall* StabilityCall::start(CallContext& context, grpc::CallbackServerContext* call,
                                    const v1::StabilityRequest& request) {
  return open<StabilityCall>(context, call, request);
}

StabilityCall::StabilityCall(CallContext& context, grpc::CallbackServerContext* call)
    : RenderReactor(context, call, "Stability") {}

Result<StabilityCall::Work> StabilityCall::prepared(StabilitySpec spec, const LoadedScene& loaded) {
  auto job = withScene(std::move(spec), loaded.scene, limits());
  if (!job) return std::unexpected(std::move(job.error()));
  frames_ = static_cast<std::uint32_t>(job->views.size());
  Work work{.accepted = {}, .outputBytes = outputBytes(*job), .run = nullptr};
  toProto(job->views.front(), work.accepted.mutable_accepted()->mutable_view());
  toProto(job->lights.front(), work.accepted.mutable_accepted()->mutable_light());
  work.run = [this, job = std::move(*job)](Renderer& renderer, const Interrupt& interrupt) {
    return renderer.runStability(job, interrupt, *this);
  };
  return work;
}

void StabilityCall::onFrame(std::size_t method, const StabilityFrame& frame) {
  v1::StabilityEvent event;
  v1::StabilityFrame& to = *event.mutable_frame();
  to.set_method(static_cast<std::uint32_t>(method));
  to.set_frame(frame.frame);
  to.set_frames(frames_);
  to.set_flips(static_cast<std::uint32_t>(frame.flips));
  push(std::move(event));
}

void StabilityCall::onPicture(std::size_t method, StabilityPicture picture) {
  v1::StabilityEvent event;
  v1::PictureBegin& begin = *event.mutable_picture_begin();
  begin.set_method(static_cast<std::uint32_t>(method));
  toProto(picture, &begin);
  push(std::move(event), std::move(picture.colour));
}

void StabilityCall::onStability(std::size_t method, StabilityResult result) {
  v1::StabilityEvent event;
  event.mutable_outcome()->set_method(static_cast<std::uint32_t>(method));
  toProto(result, event.mutable_outcome()->mutable_result());
  push(std::move(event));
}

}  // namespace sundial
