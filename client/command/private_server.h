// A sundiald of the command's own, on a socket that nobody else can reach.
#pragma once

#include <sys/types.h>

#include <memory>
#include <stop_token>
#include <string>

#include <grpcpp/channel.h>

namespace sundial::command {

struct PrivateServerOptions {
  std::string sceneRoot;  // empty: the server's default
  std::string device;     // empty: the server's choice
};

// Started by the constructor, stopped by the destructor: SIGTERM, and SIGKILL if that isn't enough. The
// kernel ends the server if the command is killed; the socket and its folder are gone as soon as the
// connection stands.
class PrivateServer {
 public:
  // Waits until the server answers. Throws Failure with the server's last line if it dies before, or when it
  // is not found: beside this executable, as $SUNDIALD, or on the PATH.
  PrivateServer(const PrivateServerOptions&, std::stop_token);
  ~PrivateServer();
  PrivateServer(const PrivateServer&) = delete;
  PrivateServer& operator=(const PrivateServer&) = delete;

  std::shared_ptr<grpc::Channel> channel() const { return channel_; }

 private:
  class Folder;
  class Process;
  std::unique_ptr<Process> process_;
  std::shared_ptr<grpc::Channel> channel_;
};

}  // namespace sundial::command
