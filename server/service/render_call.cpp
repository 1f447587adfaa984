#include "service/render_call.h"

namespace sundial {

RenderCall* RenderCall::start(CallContext& context, grpc::CallbackServerContext* call,
                              const v1::RenderRequest& request) {
  return open<RenderCall>(context, call, request);
}

RenderCall::RenderCall(CallContext& context, grpc::CallbackServerContext* call)
    : RenderReactor(context, call, "Render") {}

Result<RenderCall::Work> RenderCall::prepared(RenderSpec spec, const LoadedScene& loaded) {
  Work work{.accepted = {}, .outputBytes = spec.outputBytes, .run = nullptr};
  auto job = withScene(std::move(spec), loaded.scene);
  if (!job) return std::unexpected(std::move(job.error()));
  toProto(job->view, work.accepted.mutable_accepted()->mutable_view());
  toProto(job->light, work.accepted.mutable_accepted()->mutable_light());
  work.run = [this, job = std::move(*job)](Renderer& renderer, const Interrupt& interrupt) {
    return renderer.run(job, interrupt, *this);
  };
  return work;
}

void RenderCall::onPlan(std::size_t method, const std::vector<PlanView>& plan) {
  v1::RenderEvent event;
  event.mutable_layout()->set_method(static_cast<std::uint32_t>(method));
  toProto(plan, event.mutable_layout()->mutable_plan());
  push(std::move(event));
}

void RenderCall::onImage(std::size_t method, Image image) {
  v1::RenderEvent event;
  v1::ImageBegin& begin = *event.mutable_image_begin();
  begin.set_method(static_cast<std::uint32_t>(method));
  begin.set_aov(toProto(image.aov));
  begin.set_width(image.size.x);
  begin.set_height(image.size.y);
  begin.set_bytes(image.bytes.size());
  push(std::move(event), std::move(image.bytes));
}

void RenderCall::onResult(std::size_t method, MethodResult result) {
  v1::RenderEvent event;
  event.mutable_timings()->set_method(static_cast<std::uint32_t>(method));
  toProto(result, event.mutable_timings()->mutable_result());
  push(std::move(event));
}

}  // namespace sundial
