// The contract's rpcs. Nothing here waits: whatever takes time happens on the store's or the queue's threads.
#pragma once

#include "service/call.h"
#include "sundial/v1/sundial.grpc.pb.h"

namespace sundial {

class SundialService final : public v1::Sundial::CallbackService {
 public:
  explicit SundialService(CallContext& context) : context_(context) {}

  grpc::ServerUnaryReactor* ListMethods(grpc::CallbackServerContext*, const v1::ListMethodsRequest*,
                                        v1::ListMethodsResponse*) override;
  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext*, const v1::GetServerInfoRequest*,
                                          v1::ServerInfo*) override;
  grpc::ServerUnaryReactor* ListScenes(grpc::CallbackServerContext*, const v1::ListScenesRequest*,
                                       v1::ListScenesResponse*) override;
  grpc::ServerUnaryReactor* LoadScene(grpc::CallbackServerContext*, const v1::LoadSceneRequest*,
                                      v1::SceneInfo*) override;
  grpc::ServerUnaryReactor* UnloadScene(grpc::CallbackServerContext*, const v1::UnloadSceneRequest*,
                                        v1::UnloadSceneResponse*) override;
  grpc::ServerReadReactor<v1::UploadSceneRequest>* UploadScene(grpc::CallbackServerContext*,
                                                               v1::SceneInfo*) override;
  grpc::ServerWriteReactor<v1::RenderEvent>* Render(grpc::CallbackServerContext*,
                                                    const v1::RenderRequest*) override;
  grpc::ServerWriteReactor<v1::StabilityEvent>* Stability(grpc::CallbackServerContext*,
                                                          const v1::StabilityRequest*) override;
  grpc::ServerUnaryReactor* ListStabilityCases(grpc::CallbackServerContext*,
                                               const v1::ListStabilityCasesRequest*,
                                               v1::ListStabilityCasesResponse*) override;

 private:
  CallContext& context_;
};

}  // namespace sundial
