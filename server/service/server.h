// The server as a whole: the threads, the scenes, the gRPC listener, and how they start and stop.
#pragma once

#include <grpcpp/server.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "render_queue.h"
#include "scene_store.h"
#include "service/call.h"
#include "service/sundial_service.h"
#include "timer.h"

namespace sundial {

// PEM texts. With `clientAuthority`, clients must show a certificate that it signed.
struct TlsOptions {
  std::string certificate, key, clientAuthority;
};

struct ServerOptions {
  std::vector<std::string> listen{"127.0.0.1:50051"};  // HOST:PORT (port 0: any), [IPV6]:PORT, unix:PATH
  std::optional<TlsOptions> tls;
  QueueLimits queue;
  StoreOptions store;
  CallLimits calls;
  // Any thread, concurrently; must not throw or wait.
  std::function<void(const CallRecord&)> onEnd;
  std::function<void(const std::string& why)>
      onBroken;  // the device fails again and again: stop, and start anew
};

class Server {
 public:
  // Listens when this returns. Errors: failedPrecondition for an address that can't be had, saying why and
  // what to try; invalidArgument for one that is
  // malformed, and for certificates that can't be used.
  static Result<std::unique_ptr<Server>> start(ServerOptions, std::unique_ptr<Renderer>, SceneSource);
  ~Server();  // stop() without waiting for anybody

  // Health says NOT_SERVING, new renderings are refused, those accepted are finished and sent, for as long as
  // `patience` lasts; then everything ends. Once, from one thread.
  void stop(std::chrono::milliseconds patience);

  const std::vector<std::string>& addresses() const { return addresses_; }  // with the ports that were chosen
  const RenderQueue& queue() const { return *queue_; }
  const SceneStore& store() const { return *store_; }

 private:
  Server(ServerOptions&&, std::unique_ptr<Renderer>, SceneSource&&);
  Result<void> listen(const ServerOptions&);

  // Destroyed from the last to the first: each may use those before it.
  std::unique_ptr<RenderQueue> queue_;
  std::unique_ptr<SceneStore> store_;
  Timer timer_;
  CallContext context_;
  SundialService service_;
  std::vector<std::string> addresses_;
  std::unique_ptr<grpc::Server> grpc_;
  bool stopped_ = false;
};

// What is wrong with HOST:PORT as a text; nothing if it is well formed.
std::optional<std::string> whyMalformed(const std::string& address);

// Why nothing can listen there: "port 50051 is in use ..."; nothing if it can. `address` as in ServerOptions.
std::optional<std::string> whyNotListening(const std::string& address);

}  // namespace sundial
