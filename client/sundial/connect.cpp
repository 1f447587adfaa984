#include "sundial/connect.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>
#include <netdb.h>

#include <array>
#include <charconv>
#include <string>
#include <vector>

namespace sundial::client {
namespace {

using grpc::StatusCode;

struct HostPort {
  std::string host, port;
};

Expected<HostPort> splitHostPort(std::string_view address) {
  const auto colon = address.rfind(':');
  unsigned port = 0;
  if (colon != std::string_view::npos && colon > 0) {
    const std::string_view text = address.substr(colon + 1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error == std::errc() && end == text.data() + text.size() && port >= 1 && port <= 65535)
      return HostPort{std::string(address.substr(0, colon)), std::string(text)};
  }
  return fail(StatusCode::INVALID_ARGUMENT,
              fmt::format("'{}' is no server address; write host:port or unix:PATH", address));
}

// gRPC takes several targets only as numbers.
Expected<std::string> resolve(const HostPort& address) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (const int error = getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found); error != 0)
    return fail(StatusCode::UNAVAILABLE,
                fmt::format("can't resolve '{}': {}; check the name or give its IPv4 address", address.host,
                            gai_strerror(error)));
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(found, &freeaddrinfo);
  std::array<char, INET_ADDRSTRLEN> text{};
  const auto* ip = reinterpret_cast<const sockaddr_in*>(found->ai_addr);
  inet_ntop(AF_INET, &ip->sin_addr, text.data(), text.size());
  return fmt::format("{}:{}", text.data(), address.port);
}

}  // namespace

std::vector<std::string_view> eachAddress(std::string_view addresses) {
  std::vector<std::string_view> parts;
  if (addresses.starts_with("unix:")) return {addresses};
  for (;;) {
    const auto comma = addresses.find(',');
    parts.push_back(addresses.substr(0, comma));
    if (comma == std::string_view::npos) return parts;
    addresses.remove_prefix(comma + 1);
  }
}

Expected<std::shared_ptr<grpc::Channel>> connect(std::string_view addresses) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 50);
  // gRPC takes this one for the time that a connection's handshake may last: a busy server needs more than 50
  // ms.
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 5'000);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 2000);
  // A machine that vanishes without a word is noticed, however long a rendering says nothing.
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 20'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 10'000);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);

  std::string target;
  if (addresses.starts_with("unix:") && addresses.size() > 5) {
    target = addresses;
  } else if (const auto parts = eachAddress(addresses); parts.size() == 1) {
    if (const auto address = splitHostPort(addresses); !address) return std::unexpected(address.error());
    target = addresses;
  } else {
    std::vector<HostPort> servers;
    for (const std::string_view part : parts) {
      auto server = splitHostPort(part);
      if (!server) return std::unexpected(server.error());
      servers.push_back(std::move(*server));
    }
    for (const HostPort& server : servers) {
      const auto ip = resolve(server);
      if (!ip) return std::unexpected(ip.error());
      target += (target.empty() ? "ipv4:" : ",") + *ip;
    }
    arguments.SetServiceConfigJSON(
        R"({"loadBalancingConfig": [{"round_robin": {}}], "healthCheckConfig": {"serviceName": ""}})");
  }
  return grpc::CreateCustomChannel(target, grpc::InsecureChannelCredentials(), arguments);
}

}  // namespace sundial::client
