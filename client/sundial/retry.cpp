#include "sundial/retry.h"

#include <algorithm>
#include <charconv>
#include <condition_variable>
#include <mutex>
#include <optional>

namespace sundial::client {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds kFirstPause{100};

std::optional<milliseconds> retryHint(const grpc::ClientContext& context) {
  const auto& metadata = context.GetServerTrailingMetadata();
  const auto found = metadata.find("sundial-retry-ms");
  if (found == metadata.end()) return std::nullopt;
  unsigned value = 0;
  const auto [end, error] = std::from_chars(found->second.begin(), found->second.end(), value);
  if (error != std::errc() || end != found->second.end()) return std::nullopt;
  return milliseconds(std::clamp(value, 1u, 60'000u));
}

}  // namespace

void pause(milliseconds time, const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  never.wait_for(lock, stop, time, [] { return false; });
}

Expected<void> withRetries(const CallOptions& options, const Attempt& attempt) {
  const auto deadline = std::chrono::system_clock::now() + options.timeout;
  int queueRetries = options.queueRetries, lostRetries = options.lostRetries;
  milliseconds lostPause = kFirstPause;
  for (;;) {
    grpc::ClientContext context;
    context.set_deadline(deadline);
    const grpc::Status status = [&] {
      const std::stop_callback cancel(options.stop, [&] { context.TryCancel(); });
      return attempt(context);
    }();

    if (status.ok()) return {};

    Error error{.code = status.error_code(), .message = status.error_message()};
    if (error.code == grpc::RESOURCE_EXHAUSTED) error.retryAfter = retryHint(context);
    milliseconds wait{};
    if (error.retryAfter && queueRetries > 0) {
      --queueRetries;
      wait = *error.retryAfter;
    } else if (error.code == grpc::UNAVAILABLE && lostRetries > 0) {
      --lostRetries;
      wait = lostPause;
      lostPause *= 2;
    } else {
      return std::unexpected(std::move(error));
    }
    if (std::chrono::system_clock::now() + wait >= deadline) return std::unexpected(std::move(error));
    pause(wait, options.stop);
    if (options.stop.stop_requested()) return fail(grpc::CANCELLED, "interrupted");
  }
}

}  // namespace sundial::client
