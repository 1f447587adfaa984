#include "sweep/scene_supply.h"

#include <algorithm>

namespace sundial::sweep {
namespace {

// A question that a living server answers at once.
client::CallOptions brief(client::CallOptions options) {
  options.timeout = std::min<std::chrono::milliseconds>(options.timeout, std::chrono::seconds(10));
  options.lostRetries = 0;
  return options;
}

}  // namespace

SceneSupply::SceneSupply(const std::vector<std::shared_ptr<grpc::Channel>>& servers,
                         const client::CallOptions& options,
                         const std::map<std::string, client::SceneFiles>& files)
    : files_(files) {
  for (const auto& channel : servers)
    servers_.push_back({client::Client(channel, brief(options)), client::Client(channel, options)});
}

client::Expected<bool> SceneSupply::provide(const std::string& reference, unsigned generation) {
  const auto files = files_.find(reference);
  if (files == files_.end()) return false;
  const std::lock_guard lock(mutex_);
  if (generation != generation_) return true;  // sent while this rendering was on its way
  bool sent = false;
  for (const Server& server : servers_) {
    const auto one = provide(server, reference, files->second);
    if (!one && one.error().code != grpc::UNAVAILABLE && one.error().code != grpc::DEADLINE_EXCEEDED)
      return one;
    sent |= one.value_or(false);
  }
  if (sent) ++generation_;
  return sent;
}

client::Expected<bool> SceneSupply::provide(const Server& server, const std::string& reference,
                                            const client::SceneFiles& files) {
  const auto scenes = server.asked.listScenes();
  if (!scenes) return std::unexpected(scenes.error());
  const auto known = [&](const v1::SceneInfo& scene) {
    return scene.loaded() && "digest:" + scene.digest() == reference;
  };
  if (std::ranges::any_of(scenes->scenes(), known)) return false;
  if (auto info = server.sentTo.upload(files); !info)
    return std::unexpected(info.error());
  else if (info->reference() != reference)
    return client::fail(grpc::DATA_LOSS, "the scene's files changed since the sweep began; begin it again");
  return true;
}

}  // namespace sundial::sweep
