// When a refused call is asked again: the service's promise that the same request gives the same answer makes
// it safe.
#pragma once

#include <grpcpp/client_context.h>

#include <chrono>
#include <functional>
#include <stop_token>

namespace sundial::client {

struct CallOptions {
  std::chrono::milliseconds timeout = std::chrono::minutes(15);  // of a call with its retries
  std::stop_token stop;                                          // cancels it
};

// One try of a call, with its own context.
using Attempt = std::function<grpc::Status(grpc::ClientContext&)>;

// Tries until it works, fails for good, or the options' time is over. A full queue (RESOURCE_EXHAUSTED with
// "sundial-retry-ms" in the trailing metadata) is waited for as long as the server says and tried again up to
// 30 times; a lost server (UNAVAILABLE) after 0.1, 0.2 and 0.4 seconds.
grpc::Status withRetries(const CallOptions&, const Attempt&);

}  // namespace sundial::client
