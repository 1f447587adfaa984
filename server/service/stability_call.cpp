#include "service/stability_call.h"

namespace sundial {

StabilityCall* StabilityCall::start(CallContext& context, grpc::CallbackServerContext* call,
                                    const v1::StabilityRequest& request) {
  const auto started = std::make_shared<StabilityCall>(context, call);
  started->own(started);
  // Refuse what can never work before what can't work now.
  auto spec = fromProto(request, started->limits());
  if (!spec) {
    started->refuse(std::move(spec.error()));
    return started.get();
  }
  std::string subject = spec->scene, scene = spec->scene;
  for (const Method& method : spec->job.methods) subject.append(" ").append(method.label());
  started->begin(std::move(subject), std::move(scene),
                 [self = started.get(), spec = std::move(*spec)](const LoadedScene& loaded) mutable {
                   return self->prepared(std::move(spec), loaded);
                 });
  return started.get();
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
