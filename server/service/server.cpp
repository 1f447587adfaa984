#include "service/server.h"

#include <fmt/format.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>

#include <random>

namespace sundial {

namespace {

constexpr std::chrono::milliseconds kLastGrace{1000};  // for calls that were told to end

std::shared_ptr<grpc::ServerCredentials> credentials(const std::optional<TlsOptions>& tls) {
  if (!tls) return grpc::InsecureServerCredentials();
  grpc::SslServerCredentialsOptions options(tls->clientAuthority.empty()
                                                ? GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE
                                                : GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  options.pem_key_cert_pairs.push_back({tls->key, tls->certificate});
  options.pem_root_certs = tls->clientAuthority;
  return grpc::SslServerCredentials(options);
}

// Tells one server's request ids from another's.
std::string randomPrefix() {
  std::random_device random;
  return fmt::format("{:08x}", random());
}

}  // namespace

Server::Server(ServerOptions&& options, std::unique_ptr<Renderer> renderer, SceneSource&& source)
    : queue_(std::make_unique<RenderQueue>(std::move(renderer), options.queue)),
      store_(std::make_unique<SceneStore>(std::move(source), std::move(options.store))),
      context_{.queue = *queue_,
               .store = *store_,
               .timer = timer_,
               .limits = options.calls,
               .onEnd = std::move(options.onEnd),
               .onBroken = std::move(options.onBroken),
               .idPrefix = randomPrefix(),
               .calls = {}},
      service_(context_) {}

Result<std::unique_ptr<Server>> Server::start(ServerOptions options, std::unique_ptr<Renderer> renderer,
                                              SceneSource source) {
  auto server =
      std::unique_ptr<Server>(new Server(ServerOptions(options), std::move(renderer), std::move(source)));
  if (auto listening = server->listen(options); !listening)
    return std::unexpected(std::move(listening.error()));
  return server;
}

Result<void> Server::listen(const ServerOptions& options) {
  // Told beforehand: gRPC takes a path away from a server that still listens on it, and a port modulo 65536.
  for (const std::string& address : options.listen) {
    if (!address.starts_with("unix:")) {
      if (auto why = whyMalformed(address)) return invalid(std::move(*why));
      continue;
    }
    if (auto why = whyNotListening(address)) return fail(ErrorCode::failedPrecondition, std::move(*why));
  }
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();

  grpc::ServerBuilder builder;
  builder.RegisterService(&service_);
  // A port serves one server: without this a second one would take every other connection, silently.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  // A client that stopped is noticed within half a minute; one that is busy isn't taken for it.
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 20'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 10'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 10'000);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, 256);  // per connection
  std::vector<int> ports(options.listen.size());
  for (std::size_t i = 0; i < ports.size(); ++i) {
    builder.AddListeningPort(options.listen[i], credentials(options.tls), &ports[i]);
  }
  grpc_ = builder.BuildAndStart();
  if (!grpc_) {
    for (const std::string& address : options.listen) {
      if (auto why = whyNotListening(address)) return fail(ErrorCode::failedPrecondition, std::move(*why));
    }
    if (options.tls)
      return invalid(
          "TLS: the certificate, the key or the client authority can't be used: check that "
          "they are PEM files that belong together");
    return fail(ErrorCode::failedPrecondition, "can't listen: give another address");
  }
  grpc_->GetHealthCheckService()->SetServingStatus(v1::Sundial::service_full_name(), true);
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const std::string& address = options.listen[i];
    const bool path = address.starts_with("unix");
    addresses_.push_back(path ? address
                              : fmt::format("{}:{}", address.substr(0, address.rfind(':')), ports[i]));
  }
  return {};
}

Server::~Server() { stop(std::chrono::milliseconds(0)); }

void Server::stop(std::chrono::milliseconds patience) {
  if (stopped_) return;
  stopped_ = true;
  if (!grpc_) return;
  grpc_->GetHealthCheckService()->SetServingStatus(false);
  queue_->drain();
  context_.calls.waitForNone(std::chrono::steady_clock::now() + patience);
  // Every call that is left is told to end, so that none keeps Shutdown waiting.
  queue_->stop();
  store_->stop();
  grpc_->Shutdown(std::chrono::system_clock::now() + kLastGrace);
  grpc_->Wait();
}

}  // namespace sundial
