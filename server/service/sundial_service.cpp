#include "service/sundial_service.h"

#include <fmt/format.h>

#include "service/render_call.h"
#include "service/stability_call.h"
#include "service/status.h"
#include "service/upload_reactor.h"
#include "stability/cases.h"

#ifndef SUNDIAL_VERSION
#error "the build defines SUNDIAL_VERSION"
#endif

namespace sundial {

namespace {

// A call with one answer. Ends with finish(), on any thread; nobody touches it after that.
class UnaryCall final : public grpc::ServerUnaryReactor {
 public:
  UnaryCall(CallContext& context, grpc::CallbackServerContext* call, const char* rpc,
            std::string subject = "")
      : log_(context, *call, rpc) {
    log_.record.subject = std::move(subject);
  }
  std::stop_token stopToken() const { return stop_.get_token(); }
  UnaryCall* finish(const Result<void>& result) {
    status_ = result ? grpc::Status::OK : toStatus(result.error());
    Finish(status_);
    return this;
  }
  void OnCancel() override { stop_.request_stop(); }
  void OnDone() override {
    log_.end(status_);
    delete this;
  }

 private:
  CallLog log_;
  std::stop_source stop_;
  grpc::Status status_;
};

}  // namespace

grpc::ServerUnaryReactor* SundialService::ListMethods(grpc::CallbackServerContext* context,
                                                      const v1::ListMethodsRequest*,
                                                      v1::ListMethodsResponse* answer) {
  for (const MethodRow& row : methodTable()) toProto(row, answer->add_methods());
  return (new UnaryCall(context_, context, "ListMethods"))->finish({});
}

grpc::ServerUnaryReactor* SundialService::GetServerInfo(grpc::CallbackServerContext* context,
                                                        const v1::GetServerInfoRequest*,
                                                        v1::ServerInfo* answer) {
  const RenderQueue& queue = context_.queue;
  const RenderQueue::Counts counts = queue.counts();
  answer->set_version(SUNDIAL_VERSION);
  answer->set_device(queue.device().name);
  answer->set_driver(queue.device().driver);
  answer->set_max_image_side(context_.limits.request.imageSide);
  answer->set_max_queued(static_cast<std::uint32_t>(queue.limits().waiting));
  answer->set_max_queued_per_client(static_cast<std::uint32_t>(queue.limits().waitingPerClient));
  answer->set_queued(static_cast<std::uint32_t>(counts.waiting));
  answer->set_rendering(static_cast<std::uint32_t>(counts.rendering));
  answer->set_validation_messages(queue.validationMessages());
  return (new UnaryCall(context_, context, "GetServerInfo"))->finish({});
}

grpc::ServerUnaryReactor* SundialService::ListScenes(grpc::CallbackServerContext* context,
                                                     const v1::ListScenesRequest*,
                                                     v1::ListScenesResponse* answer) {
  auto* call = new UnaryCall(context_, context, "ListScenes");
  context_.store.list([call, answer](Result<std::vector<SceneListing>> scenes) {
    if (!scenes) {
      call->finish(std::unexpected(std::move(scenes.error())));
      return;
    }
    for (const SceneListing& scene : *scenes) toProto(scene, answer->add_scenes());
    call->finish({});
  });
  return call;
}

grpc::ServerUnaryReactor* SundialService::LoadScene(grpc::CallbackServerContext* context,
                                                    const v1::LoadSceneRequest* request,
                                                    v1::SceneInfo* answer) {
  auto* call = new UnaryCall(context_, context, "LoadScene", request->scene());
  if (request->scene().size() > kMaxNameLength) {
    return call->finish(invalid(
        fmt::format("scene has {} bytes: must have 1 to {}", request->scene().size(), kMaxNameLength)));
  }
  context_.store.load(request->scene(), true, call->stopToken(), [call, answer](Result<LoadedScene> loaded) {
    if (!loaded) {
      call->finish(std::unexpected(std::move(loaded.error())));
      return;
    }
    toProto(*loaded, answer);
    call->finish({});
  });
  return call;
}

grpc::ServerUnaryReactor* SundialService::UnloadScene(grpc::CallbackServerContext* context,
                                                      const v1::UnloadSceneRequest* request,
                                                      v1::UnloadSceneResponse*) {
  auto* call = new UnaryCall(context_, context, "UnloadScene", request->scene());
  return call->finish(context_.store.unload(request->scene()));
}

grpc::ServerReadReactor<v1::UploadSceneRequest>* SundialService::UploadScene(
    grpc::CallbackServerContext* context, v1::SceneInfo* answer) {
  return UploadReactor::start(context_, context, answer);
}

grpc::ServerWriteReactor<v1::RenderEvent>* SundialService::Render(grpc::CallbackServerContext* context,
                                                                  const v1::RenderRequest* request) {
  return RenderCall::start(context_, context, *request);
}

grpc::ServerWriteReactor<v1::StabilityEvent>* SundialService::Stability(grpc::CallbackServerContext* context,
                                                                        const v1::StabilityRequest* request) {
  return StabilityCall::start(context_, context, *request);
}

grpc::ServerUnaryReactor* SundialService::ListStabilityCases(grpc::CallbackServerContext* context,
                                                             const v1::ListStabilityCasesRequest*,
                                                             v1::ListStabilityCasesResponse* answer) {
  for (const StabilityCase& row : stabilityCases()) toProto(row, answer->add_cases());
  return (new UnaryCall(context_, context, "ListStabilityCases"))->finish({});
}

}  // namespace sundial
