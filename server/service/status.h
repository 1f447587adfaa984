// Errors as gRPC says them.
#pragma once

#include <grpcpp/support/status.h>

#include "result.h"
#include "sundial/status_name.h"

namespace sundial {

inline grpc::StatusCode statusCode(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalidArgument:
      return grpc::StatusCode::INVALID_ARGUMENT;
    case ErrorCode::notFound:
      return grpc::StatusCode::NOT_FOUND;
    case ErrorCode::failedPrecondition:
      return grpc::StatusCode::FAILED_PRECONDITION;
    case ErrorCode::resourceExhausted:
      return grpc::StatusCode::RESOURCE_EXHAUSTED;
    case ErrorCode::deadlineExceeded:
      return grpc::StatusCode::DEADLINE_EXCEEDED;
    case ErrorCode::cancelled:
      return grpc::StatusCode::CANCELLED;
    case ErrorCode::dataLoss:
      return grpc::StatusCode::DATA_LOSS;
    case ErrorCode::unavailable:
      return grpc::StatusCode::UNAVAILABLE;
  }
  return grpc::StatusCode::UNKNOWN;
}

// One line, short enough for a client's limit on metadata (8 KiB, escaped).
inline grpc::Status toStatus(const Error& error) {
  std::string message = error.message.substr(0, 2000);
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return {statusCode(error.code), message};
}

}  // namespace sundial
