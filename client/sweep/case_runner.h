// A case's rendering and its run along a path, whatever becomes of the server that begins them.
#pragma once

#include <grpcpp/channel.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "sundial/client.h"
#include "sweep/scene_supply.h"

namespace sundial::sweep {

// No server has answered for too long.
struct ServersGone : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class CaseRunner {
 public:
  // `all` shares the calls among the servers. The supply must outlive the runner.
  CaseRunner(std::shared_ptr<grpc::Channel> all, SceneSupply&, client::CallOptions,
             std::chrono::milliseconds patience);

  // Each waits while the queues are full, and for a server to come back; asks again for what a lost server
  // began. Errors: the case's own (INVALID_ARGUMENT ...), which would come again; what a case ends in that
  // loses its server kMostLosses times; CANCELLED after a stop. Throws ServersGone. Any thread.
  client::Expected<client::Rendering> render(const v1::RenderRequest&);
  client::Expected<client::Stability> stability(const v1::StabilityRequest&);

  static constexpr int kMostLosses = 10;

 private:
  // One try; calls `onAccepted` once the server has begun.
  template <class Answer>
  using Try = std::function<client::Expected<Answer>(const std::function<void()>& onAccepted)>;

  template <class Answer>
  client::Expected<Answer> untilAnswered(const std::string& scene, const Try<Answer>&);
  void awaitServer();
  void answered();
  void unanswered(const std::string& why);

  const std::shared_ptr<grpc::Channel> channel_;
  SceneSupply& supply_;
  const client::CallOptions options_;
  const std::chrono::milliseconds patience_;
  const client::Client client_;
  std::mutex mutex_;
  std::optional<std::chrono::steady_clock::time_point> silentSince_;  // no server has answered since then
};

}  // namespace sundial::sweep
