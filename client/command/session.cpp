#include "command/session.h"

#include <fmt/format.h>

#include <algorithm>

#include "sundial/connect.h"

namespace sundial::command {

namespace {

std::shared_ptr<grpc::Channel> connected(std::string_view addresses) {
  auto channel = client::connect(addresses);
  if (!channel)
    throw Failure(channel.error().code == grpc::INVALID_ARGUMENT ? 2 : 1, channel.error().message);
  return std::move(*channel);
}

}  // namespace

bool isLocalFile(const std::string& scene) {
  return scene.starts_with("/") || scene.starts_with("./") || scene.starts_with("../");
}

Session::Session(GlobalOptions options, const Interrupt& interrupt)
    : options_(std::move(options)), interrupt_(interrupt) {}

const client::Client& Session::client() {
  if (!client_) client_.emplace(channel(), callOptions());
  return *client_;
}

client::CallOptions Session::callOptions() const {
  return {.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(options_.timeoutSeconds * 1000)),
          .stop = interrupt_.token()};
}

std::shared_ptr<grpc::Channel> Session::channel() {
  if (channel_) return channel_;
  if (options_.server.empty()) {
    privateServer_.emplace(options_.privateServer, interrupt_.token());
    return channel_ = privateServer_->channel();
  }
  return channel_ = connected(options_.server);
}

std::vector<std::shared_ptr<grpc::Channel>> Session::eachServer() {
  const auto addresses = client::eachAddress(options_.server);
  if (addresses.size() == 1) return {channel()};
  std::vector<std::shared_ptr<grpc::Channel>> channels;
  for (const std::string_view address : addresses) channels.push_back(connected(address));
  return channels;
}

std::string Session::sceneReference(const std::string& scene) {
  if (!isLocalFile(scene)) return scene;
  return upload(orRefuse(client::gatherSceneFiles(scene))).reference();
}

v1::SceneInfo Session::upload(const client::SceneFiles& files) {
  const client::Client& server = client();
  ProgressBar bar("Uploading", options_.quiet);
  return answer(server.upload(files, [&](const client::Progress& progress) {
    bar.show(static_cast<double>(progress.bytes), static_cast<double>(progress.bytesExpected));
  }));
}

client::Rendering Session::render(const v1::RenderRequest& request) {
  const client::Client& server = client();
  ProgressBar bar("Rendering", options_.quiet);
  // A method is done with its times; the share of its images moves the bar in between.
  const auto methods = static_cast<double>(request.methods_size());
  return answer(server.render(request, [&](const client::Progress& progress) {
    const double images = progress.bytesExpected ? static_cast<double>(progress.bytes) /
                                                       static_cast<double>(progress.bytesExpected)
                                                 : 0;
    bar.show(std::max(progress.methodsDone / methods, images), 1);
  }));
}

std::vector<client::MethodStability> Session::stability(const v1::StabilityRequest& request,
                                                        const std::string& title) {
  const client::Client& server = client();
  ProgressBar bar(title, options_.quiet);
  return answer(server.stability(request,
                                 [&](double done, double total) {
                                   if (total > 0) bar.show(done, total);
                                 }))
      .methods;
}

Failure Session::explained(const client::Error& error) const {
  if (interrupt_.signal() != 0) return failure("interrupted");
  if (error.code == grpc::UNAVAILABLE && privateServer_)
    return failure(fmt::format(
        "the private sundiald was lost ({}); start one by hand and use --server to see why", error.message));
  if (error.code == grpc::UNAVAILABLE)
    return failure(
        fmt::format("no server answers at {} ({}); start 'sundiald --listen {}' or leave out --server",
                    options_.server, error.message, options_.server));
  if (error.code == grpc::DEADLINE_EXCEEDED)
    return failure(fmt::format("{}; --timeout is {} seconds: raise it or ask for less", error.message,
                               options_.timeoutSeconds));
  return failure(error.message);
}

void Session::needServer(const std::string& command) const {
  if (options_.server.empty())
    throw refusal(fmt::format("{} needs a server that outlives it; start sundiald and add --server HOST:PORT",
                              command));
}

}  // namespace sundial::command
