// Talks to a server, or to several behind one channel. Thin: messages, streams and files, nothing of Vulkan.
#pragma once

#include <grpcpp/channel.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "sundial/rendering.h"
#include "sundial/retry.h"
#include "sundial/scene_files.h"
#include "sundial/stability.h"
#include "sundial/v1/sundial.grpc.pb.h"

namespace sundial::client {

// How far a call has come. Called on the calling thread; a retry starts again at 0.
struct Progress {
  std::uint64_t bytes = 0, bytesExpected = 0;
  unsigned methodsDone = 0;    // of a rendering
  unsigned queuePosition = 0;  // when it was accepted
};
using OnProgress = std::function<void(const Progress&)>;

// Errors are the server's (the contract lists them for each rpc), or UNAVAILABLE where none answers. Calls
// are retried as withRetries() says. Safe to use from several threads.
class Client {
 public:
  explicit Client(std::shared_ptr<grpc::Channel>, CallOptions = {});

  Expected<v1::ServerInfo> serverInfo() const;
  Expected<v1::ListMethodsResponse> listMethods() const;
  Expected<v1::ListScenesResponse> listScenes() const;
  Expected<v1::SceneInfo> load(const std::string& scene) const;
  Expected<v1::UnloadSceneResponse> unload(const std::string& scene) const;

  // Sends the files in chunks of 256 KiB; the answer's `reference` names the scene in requests.
  // Also DATA_LOSS when a file changes while it is read.
  Expected<v1::SceneInfo> upload(const SceneFiles&, const OnProgress& = {}) const;

  Expected<v1::ListStabilityCasesResponse> stabilityCases() const;

  // These return only what arrived whole: else DATA_LOSS.
  Expected<Rendering> render(const v1::RenderRequest&, const OnProgress& = {}) const;
  // Called with the frames of all methods that are done, and how many there are.
  Expected<Stability> stability(const v1::StabilityRequest&,
                                const std::function<void(double done, double total)>& = {}) const;

 private:
  std::unique_ptr<v1::Sundial::Stub> stub_;
  CallOptions options_;
};

}  // namespace sundial::client
