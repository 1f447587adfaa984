// What every command gets: the options for all, and a server once it is asked for.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command/failure.h"
#include "command/interrupt.h"
#include "command/private_server.h"
#include "command/progress.h"
#include "sundial/client.h"

namespace sundial::command {

struct GlobalOptions {
  std::string server;  // addresses; empty: a private server
  PrivateServerOptions privateServer;
  double timeoutSeconds = 900;
  bool json = false;
  bool quiet = false;
};

class Session {
 public:
  Session(GlobalOptions, const Interrupt&);

  const GlobalOptions& options() const { return options_; }

  // Connects, or starts the private server, on the first call: after the command has checked what it can.
  const client::Client& client();

  // The same server or servers, for who needs other options or each of several by itself.
  client::CallOptions callOptions() const;
  std::shared_ptr<grpc::Channel> channel();
  std::vector<std::shared_ptr<grpc::Channel>> eachServer();

  // What requests call the scene: a local file (it begins with / or ./ or ../) is uploaded first.
  std::string sceneReference(const std::string& scene);
  v1::SceneInfo upload(const client::SceneFiles&);

  // A call's answer, or a Failure: the server's own words, or where none answered and what to do about it.
  template <class T>
  T answer(client::Expected<T> value) const {
    if (!value) throw explained(value.error());
    return std::move(*value);
  }

  // Throws a refusal unless --server names a server that outlives the command.
  void needServer(const std::string& command) const;

  // Of one rendering of `methods` methods, on the terminal if there is one.
  client::Rendering render(const v1::RenderRequest&);
  std::vector<client::MethodStability> stability(const v1::StabilityRequest&, const std::string& title);

 private:
  Failure explained(const client::Error&) const;

  GlobalOptions options_;
  const Interrupt& interrupt_;
  std::optional<PrivateServer> privateServer_;
  std::shared_ptr<grpc::Channel> channel_;
  std::optional<client::Client> client_;
};

bool isLocalFile(const std::string& scene);

}  // namespace sundial::command
