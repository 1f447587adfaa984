#include "service/call.h"

#include <fmt/format.h>

#include <algorithm>

namespace sundial {

void CallCount::begin() {
  const std::lock_guard lock(mutex_);
  ++count_;
}

void CallCount::end() {
  const std::lock_guard lock(mutex_);
  --count_;
  changed_.notify_all();
}

bool CallCount::waitForNone(std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(mutex_);
  return changed_.wait_until(lock, until, [&] { return count_ == 0; });
}

CallLog::CallLog(CallContext& context, const grpc::CallbackServerContext& call, std::string rpc)
    : context_(context), begin_(std::chrono::steady_clock::now()) {
  record.id = fmt::format("{}-{}", context.idPrefix, ++context.lastId);
  record.rpc = std::move(rpc);
  record.client = clientOf(call);
}

void CallLog::end(const grpc::Status& status) {
  record.status = status.error_code();
  record.message = status.error_message();
  record.totalMs =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_).count();
  if (context_.onEnd) context_.onEnd(record);
}

std::string clientOf(const grpc::CallbackServerContext& call) {
  if (const auto auth = call.auth_context(); auth && auth->IsPeerAuthenticated()) {
    std::string identity;
    for (const grpc::string_ref& part : auth->GetPeerIdentity()) identity.append(part.data(), part.size());
    if (!identity.empty()) return identity;
  }
  return call.peer();
}

std::chrono::steady_clock::time_point deadlineOf(const grpc::CallbackServerContext& call,
                                                 const CallLimits& limits) {
  std::chrono::system_clock::duration left = limits.defaultDeadline;
  if (call.deadline() != std::chrono::system_clock::time_point::max()) {
    left = std::min<std::chrono::system_clock::duration>(call.deadline() - std::chrono::system_clock::now(),
                                                         limits.maxDeadline);
  }
  return std::chrono::steady_clock::now() + left;
}

}  // namespace sundial
