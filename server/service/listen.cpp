#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

#include "service/server.h"

namespace sundial {

namespace {

class Socket {
 public:
  explicit Socket(int family) : descriptor_(::socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  const int descriptor_;
};

std::optional<std::string> whyNotPath(const std::string& path) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(name.sun_path)) {
    return fmt::format("unix:{}: a socket's path has 1 to {} bytes", path, sizeof(name.sun_path) - 1);
  }
  std::memcpy(name.sun_path, path.data(), path.size());
  const Socket client(AF_UNIX);
  if (::connect(client.descriptor(), reinterpret_cast<const sockaddr*>(&name), sizeof(name)) == 0) {
    return fmt::format("unix:{} is in use by another server: stop it, or give another path", path);
  }
  if (errno == ENOENT) {
    // Free, if its folder lets us make it.
    const Socket server(AF_UNIX);
    if (::bind(server.descriptor(), reinterpret_cast<const sockaddr*>(&name), sizeof(name)) != 0) {
      return fmt::format("can't make unix:{}: {}; give --listen a path in a folder that exists and is yours",
                         path, std::strerror(errno));
    }
    ::unlink(path.c_str());
  } else if (errno == ENOTSOCK || (errno == ECONNREFUSED && ::access(path.c_str(), W_OK) != 0)) {
    return fmt::format("can't make unix:{}: something else is there; give another path", path);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> whyMalformed(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos || colon == 0)
    return fmt::format("{}: give HOST:PORT or unix:PATH", address);
  const std::string_view digits = std::string_view(address).substr(colon + 1);
  unsigned port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (error != std::errc() || end != digits.data() + digits.size() || port > 65535) {
    return fmt::format("{}: port {} must lie in [0, 65535]", address, digits);
  }
  return std::nullopt;
}

std::optional<std::string> whyNotListening(const std::string& address) {
  if (address.starts_with("unix:")) return whyNotPath(address.substr(5));
  if (auto why = whyMalformed(address)) return why;
  const std::size_t colon = address.rfind(':');
  std::string host = address.substr(0, colon);
  const std::string port = address.substr(colon + 1);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);

  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  if (const int error = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found); error != 0) {
    return fmt::format("{}: {}; give HOST:PORT or unix:PATH", address, ::gai_strerror(error));
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> all(found, &::freeaddrinfo);
  for (const addrinfo* one = found; one; one = one->ai_next) {
    const Socket socket(one->ai_family);
    const int on = 1;
    ::setsockopt(socket.descriptor(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
    if (::bind(socket.descriptor(), one->ai_addr, one->ai_addrlen) == 0 &&
        ::listen(socket.descriptor(), 1) == 0) {
      continue;
    }
    if (errno == EADDRINUSE) {
      return fmt::format(
          "port {} of {} is in use: stop the server that has it, or give another port "
          "(0: any that is free)",
          port, host);
    }
    return fmt::format("can't listen on {}: {}; give another address", address, std::strerror(errno));
  }
  return std::nullopt;
}

}  // namespace sundial
