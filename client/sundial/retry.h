// When a refused call is asked again: the service's promise that the same request gives the same answer makes
// it safe.
#pragma once

#include <grpcpp/client_context.h>

#include <chrono>
#include <functional>
#include <stop_token>

#include "sundial/error.h"

namespace sundial::client {

struct CallOptions {
  std::chrono::milliseconds timeout = std::chrono::minutes(15);  // of a call with its retries
  std::stop_token stop;                                          // cancels it
  int queueRetries = 30;                                         // after a full queue
  int lostRetries = 3;                                           // after a lost server
};

// One try of a call, with its own context.
using Attempt = std::function<grpc::Status(grpc::ClientContext&)>;

// Tries until it works, fails for good, or the options' time is over. A full queue (RESOURCE_EXHAUSTED with
// "sundial-retry-ms" in the trailing metadata) is waited for as long as the server says; a lost server
// (UNAVAILABLE) for 0.1 seconds, and each time twice as long.
Expected<void> withRetries(const CallOptions&, const Attempt&);

// Returns early when a stop is requested.
void pause(std::chrono::milliseconds, const std::stop_token&);

}  // namespace sundial::client
