#include "sweep/case_runner.h"

#include <fmt/format.h>

#include <algorithm>

namespace sundial::sweep {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kGlance{100};  // how often a wait for a server looks for a stop
constexpr int kMostDoublings = 4;     // of the pause after a loss: 0.1 to 1.6 seconds
constexpr int kMostUploads = 5;       // of a scene that servers let go of again and again

client::CallOptions once(client::CallOptions options) {
  options.queueRetries = options.lostRetries = 0;
  return options;
}

// What a lost server, connection or proxy looks like, where the request itself was good.
bool isLoss(grpc::StatusCode code, bool accepted) {
  switch (code) {
    case grpc::UNAVAILABLE:
    case grpc::UNKNOWN:
    case grpc::INTERNAL:
    case grpc::ABORTED:
    case grpc::CANCELLED:
      return true;
    case grpc::DATA_LOSS:  // before: of the scene's file
      return accepted;
    default:
      return false;
  }
}

}  // namespace

CaseRunner::CaseRunner(std::shared_ptr<grpc::Channel> all, SceneSupply& supply, client::CallOptions options,
                       milliseconds patience)
    : channel_(std::move(all)),
      supply_(supply),
      options_(std::move(options)),
      patience_(patience),
      client_(channel_, once(options_)) {}

client::Expected<client::Rendering> CaseRunner::render(const v1::RenderRequest& request) {
  return untilAnswered<client::Rendering>(request.scene(), [&](const auto& onAccepted) {
    return client_.render(request, [&](const client::Progress&) { onAccepted(); });
  });
}

client::Expected<client::Stability> CaseRunner::stability(const v1::StabilityRequest& request) {
  return untilAnswered<client::Stability>(request.scene(), [&](const auto& onAccepted) {
    return client_.stability(request, [&](double, double) { onAccepted(); });
  });
}

template <class Answer>
client::Expected<Answer> CaseRunner::untilAnswered(const std::string& scene, const Try<Answer>& attempt) {
  const auto stopped = [] { return client::fail(grpc::CANCELLED, "interrupted"); };
  for (int losses = 0, doublings = 0, uploads = 0;;) {
    awaitServer();
    if (options_.stop.stop_requested()) return stopped();
    const unsigned generation = supply_.generation();
    bool accepted = false;
    auto answer = attempt([&] {
      if (!accepted) answered();
      accepted = true;
    });
    if (options_.stop.stop_requested()) return stopped();
    if (answer) {
      answered();
      return answer;
    }
    const client::Error& error = answer.error();
    if (error.retryAfter) {
      answered();
      client::pause(*error.retryAfter, options_.stop);
    } else if (isLoss(error.code, accepted)) {
      // What was begun, or ended strangely, counts against the case: it may be what kills
      // servers.
      if ((accepted || error.code != grpc::UNAVAILABLE) && ++losses == kMostLosses) {
        answered();
        return client::fail(error.code, fmt::format("its server was lost {} times; the last time: {}", losses,
                                                    error.message));
      }
      unanswered(error.message);
      // One that refuses may do so for a while; what was lost in the middle goes elsewhere at once.
      client::pause(kGlance * (1 << std::min(accepted ? 0 : doublings++, kMostDoublings)), options_.stop);
    } else {
      answered();
      if (error.code != grpc::NOT_FOUND || uploads++ == kMostUploads) return answer;
      const auto sent = supply_.provide(scene, generation);
      if (!sent) return std::unexpected(sent.error());
      if (!*sent) return answer;
    }
  }
}

// Returns when a server is there, or a stop is requested.
void CaseRunner::awaitServer() {
  while (!options_.stop.stop_requested() &&
         !channel_->WaitForConnected(std::chrono::system_clock::now() + kGlance))
    unanswered("no connection");
}

void CaseRunner::answered() {
  const std::lock_guard lock(mutex_);
  silentSince_.reset();
}

void CaseRunner::unanswered(const std::string& why) {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (!silentSince_) silentSince_ = now;
  if (now - *silentSince_ < patience_) return;
  throw ServersGone(fmt::format("no server has answered for {:.0f} s ({})",
                                std::chrono::duration<double>(now - *silentSince_).count(), why));
}

}  // namespace sundial::sweep
