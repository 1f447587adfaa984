#include "sundial/retry.h"

#include <algorithm>
#include <charconv>
#include <condition_variable>
#include <mutex>
#include <optional>

namespace sundial::client {
namespace {

using std::chrono::milliseconds;
constexpr int kQueueRetries = 30;
constexpr int kLostRetries = 3;

std::optional<milliseconds> retryHint(const grpc::ClientContext& context) {
  const auto& metadata = context.GetServerTrailingMetadata();
  const auto found = metadata.find("sundial-retry-ms");
  if (found == metadata.end()) return std::nullopt;
  unsigned value = 0;
  const auto [end, error] = std::from_chars(found->second.begin(), found->second.end(), value);
  if (error != std::errc() || end != found->second.end()) return std::nullopt;
  return milliseconds(std::clamp(value, 1u, 60'000u));
}

// Returns early when a stop is requested.
void pause(milliseconds time, const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  never.wait_for(lock, stop, time, [] { return false; });
}

}  // namespace

grpc::Status withRetries(const CallOptions& options, const Attempt& attempt) {
  const auto deadline = std::chrono::system_clock::now() + options.timeout;
  int queueRetries = kQueueRetries, lostRetries = kLostRetries;
  for (;;) {
    grpc::ClientContext context;
    context.set_deadline(deadline);
    const grpc::Status status = [&] {
      const std::stop_callback cancel(options.stop, [&] { context.TryCancel(); });
      return attempt(context);
    }();

    milliseconds wait{};
    if (const auto hint = retryHint(context);
        status.error_code() == grpc::RESOURCE_EXHAUSTED && hint && queueRetries > 0) {
      --queueRetries;
      wait = *hint;
    } else if (status.error_code() == grpc::UNAVAILABLE && lostRetries > 0) {
      wait = milliseconds(100 << (kLostRetries - lostRetries));
      --lostRetries;
    } else {
      return status;
    }
    if (std::chrono::system_clock::now() + wait >= deadline) return status;
    pause(wait, options.stop);
    if (options.stop.stop_requested()) return {grpc::CANCELLED, "interrupted"};
  }
}

}  // namespace sundial::client
