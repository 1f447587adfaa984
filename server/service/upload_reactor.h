// A scene's files as a stream of parts. Nothing is kept of an upload that fails, stalls or is given up.
#pragma once

#include <grpcpp/support/server_callback.h>

#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "service/call.h"
#include "sundial/v1/sundial.pb.h"

namespace sundial {

class UploadReactor final : public grpc::ServerReadReactor<v1::UploadSceneRequest>,
                            public std::enable_shared_from_this<UploadReactor> {
 public:
  // Owned by the call until gRPC is done with it, and by the store while it loads.
  static UploadReactor* start(CallContext&, grpc::CallbackServerContext*, v1::SceneInfo* answer);

  UploadReactor(CallContext&, grpc::CallbackServerContext*, v1::SceneInfo* answer);
  ~UploadReactor() override;

  void OnReadDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  Result<void> take();       // part_
  Result<void> takeChunk();  // the same
  void load();
  void onScene(Result<LoadedScene>);
  void end(const grpc::Status&);  // the first one counts
  void arm(std::chrono::steady_clock::time_point);
  void onTime();

  CallContext& context_;
  grpc::CallbackServerContext* const call_;
  v1::SceneInfo* const answer_;
  CallLog log_;
  std::shared_ptr<UploadReactor> self_;
  std::stop_source stop_;

  v1::UploadSceneRequest part_;  // gRPC's while a read is in flight

  std::mutex mutex_;  // guards what follows
  SceneFiles files_;
  std::string* file_ = nullptr;  // the one begun last
  std::uint64_t bytes_ = 0;      // counted in CallContext::uploadBytes
  std::optional<grpc::Status> status_;
  bool reading_ = true;
  std::chrono::steady_clock::time_point lastRead_;
  std::optional<Timer::Id> alarm_;
};

}  // namespace sundial
