// One Render call: what its request asks of the renderer, and the renderer's results as events.
#pragma once

#include "service/render_reactor.h"

namespace sundial {

class RenderCall final : public RenderReactor<v1::RenderEvent>, public JobSink {
 public:
  static RenderCall* start(CallContext&, grpc::CallbackServerContext*, const v1::RenderRequest&);

  RenderCall(CallContext&, grpc::CallbackServerContext*);

  void onPlan(std::size_t method, const std::vector<PlanView>&) override;
  void onImage(std::size_t method, Image) override;
  void onResult(std::size_t method, MethodResult) override;

 private:
  friend RenderReactor;  // calls this
  Result<Work> prepared(RenderSpec, const LoadedScene&);
};

}  // namespace sundial
