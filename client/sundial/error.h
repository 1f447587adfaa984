// How a call fails: a gRPC status code that a program can act on, and one line for a person.
#pragma once

#include <grpcpp/support/status.h>

#include <chrono>
#include <expected>
#include <optional>
#include <string>
#include <utility>

namespace sundial::client {

struct Error {
  grpc::StatusCode code;
  std::string message;                                                 // what failed, why, and what to try
  std::optional<std::chrono::milliseconds> retryAfter = std::nullopt;  // a full queue's hint
};

template <class T>
using Expected = std::expected<T, Error>;

inline std::unexpected<Error> fail(grpc::StatusCode code, std::string message) {
  return std::unexpected(Error{.code = code, .message = std::move(message)});
}
inline std::unexpected<Error> fail(const grpc::Status& status) {
  return fail(status.error_code(), status.error_message());
}

}  // namespace sundial::client
