// A server without a renderer: it serves a small synthetic scene (synthetic_scene.h) and misbehaves on
// request.
#pragma once

#include <grpcpp/server.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "sundial/v1/sundial.grpc.pb.h"

namespace sundial::test {

// A folder that goes away with its owner.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

class FakeServer final : public v1::Sundial::Service {
 public:
  FakeServer();  // on a socket of its own
  explicit FakeServer(std::string address);
  ~FakeServer() override;

  const std::string& address() const { return address_; }
  int port() const { return port_; }  // chosen, where the address is HOST:0

  // How it misbehaves. Set before a call.
  std::function<bool(v1::RenderEvent&)>
      tamper;                      // changes an event; false: the stream ends before it, with `brokenOff`
  grpc::Status brokenOff;          // OK at first
  std::atomic<int> queueFull = 0;  // so many calls meet a full queue, retry after 1 ms
  std::atomic<int> lost = 0;       // so many calls end in UNAVAILABLE
  std::function<void()> hang;      // called, and then renderings go on until they are cancelled
  grpc::Status refusal;            // of every rendering and upload, unless OK
  std::function<grpc::Status(const v1::RenderRequest&)> judge;        // the same, of one rendering
  std::function<grpc::Status(const v1::StabilityRequest&)> judgeRun;  // the same, of one run along a path
  std::function<bool(v1::StabilityEvent&)> tamperRun;                 // as `tamper`
  void forget();                                                      // all scenes that were uploaded

  // What it got.
  std::atomic<int> renderings = 0, runs = 0, uploads = 0;
  v1::RenderRequest lastRequest;
  v1::StabilityRequest lastRun;
  std::string uploadedMain;
  std::map<std::string, std::string> uploaded;  // contents by URI
  std::size_t largestChunk = 0;

  grpc::Status ListMethods(grpc::ServerContext*, const v1::ListMethodsRequest*,
                           v1::ListMethodsResponse*) override;
  grpc::Status GetServerInfo(grpc::ServerContext*, const v1::GetServerInfoRequest*, v1::ServerInfo*) override;
  grpc::Status ListScenes(grpc::ServerContext*, const v1::ListScenesRequest*,
                          v1::ListScenesResponse*) override;
  grpc::Status LoadScene(grpc::ServerContext*, const v1::LoadSceneRequest*, v1::SceneInfo*) override;
  grpc::Status UploadScene(grpc::ServerContext*, grpc::ServerReader<v1::UploadSceneRequest>*,
                           v1::SceneInfo*) override;
  grpc::Status UnloadScene(grpc::ServerContext*, const v1::UnloadSceneRequest*,
                           v1::UnloadSceneResponse*) override;
  grpc::Status Render(grpc::ServerContext*, const v1::RenderRequest*,
                      grpc::ServerWriter<v1::RenderEvent>*) override;
  // Knows the path "walk". Nothing flips with sm.
  grpc::Status Stability(grpc::ServerContext*, const v1::StabilityRequest*,
                         grpc::ServerWriter<v1::StabilityEvent>*) override;

 private:
  grpc::Status misbehave(grpc::ServerContext&);
  bool knows(const std::string& scene);

  std::mutex mutex_;               // calls may come at once
  std::set<std::string> digests_;  // of uploaded scenes

  TemporaryFolder folder_;
  std::string address_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace sundial::test
