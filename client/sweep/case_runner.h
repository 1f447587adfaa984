// A case's rendering, whatever becomes of the server that begins it.
#pragma once

#include <grpcpp/channel.h>

#include <chrono>
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

  // Waits while the queues are full, and for a server to come back; renders again what a lost server began.
  // Errors: the case's own (INVALID_ARGUMENT ...), which would come again; what a case ends in that loses its
  // server kMostLosses times; CANCELLED after a stop. Throws ServersGone. Any thread.
  client::Expected<client::Rendering> render(const v1::RenderRequest&);

  static constexpr int kMostLosses = 10;

 private:
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
