// One Stability call: what its request asks of the renderer, and the renderer's results as events.
#pragma once

#include "service/convert_stability.h"
#include "service/render_reactor.h"

namespace sundial {

class StabilityCall final : public RenderReactor<v1::StabilityEvent>, public StabilitySink {
 public:
  static StabilityCall* start(CallContext&, grpc::CallbackServerContext*, const v1::StabilityRequest&);

  StabilityCall(CallContext&, grpc::CallbackServerContext*);

  void onFrame(std::size_t method, const StabilityFrame&) override;
  void onPicture(std::size_t method, StabilityPicture) override;
  void onStability(std::size_t method, StabilityResult) override;

 private:
  friend RenderReactor;  // calls this
  Result<Work> prepared(StabilitySpec, const LoadedScene&);

  std::uint32_t frames_ = 0;  // of the job; set before it is queued
};

}  // namespace sundial
