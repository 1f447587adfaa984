// Local scenes on every server of a sweep, however often one of them forgets.
#pragma once

#include <grpcpp/channel.h>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "sundial/client.h"

namespace sundial::sweep {

class SceneSupply {
 public:
  // A channel to each server by itself. `files` by reference, as Cases has them; must outlive the supply.
  SceneSupply(const std::vector<std::shared_ptr<grpc::Channel>>&, const client::CallOptions&,
              const std::map<std::string, client::SceneFiles>& files);

  // Changes when a scene was sent. Ask before a rendering.
  unsigned generation() const { return generation_; }

  // After a rendering's NOT_FOUND: sends the scene to the servers that don't have it. False if none lacks it,
  // so that something else wasn't found. Servers that don't answer are passed over. Errors: a server's
  // refusal of the files. Any thread.
  client::Expected<bool> provide(const std::string& reference, unsigned generation);

 private:
  struct Server {
    client::Client asked, sentTo;
  };
  client::Expected<bool> provide(const Server&, const std::string& reference, const client::SceneFiles&);

  std::vector<Server> servers_;
  const std::map<std::string, client::SceneFiles>& files_;
  std::mutex mutex_;  // one supplies, others wait and find it done
  std::atomic<unsigned> generation_ = 0;
};

}  // namespace sundial::sweep
