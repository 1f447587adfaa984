// What every call has: an identity, an end that is logged and counted, the parts of the server that it uses.
#pragma once

#include <grpcpp/server_context.h>
#include <grpcpp/support/status.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "render_queue.h"
#include "scene_store.h"
#include "service/convert.h"
#include "timer.h"

namespace sundial {

// A call that has ended, for logs and metrics.
struct CallRecord {
  std::string id, rpc, client;
  std::string subject;  // scene and methods, or ""
  grpc::StatusCode status = grpc::StatusCode::OK;
  std::string message;
  double totalMs = 0;
  double renderMs = 0;          // on the device's thread
  std::uint64_t bytesSent = 0;  // of images
};

struct CallLimits {
  RequestLimits request;
  std::uint64_t uploadBytes = 2ull << 30;  // of all uploads in flight
  std::chrono::milliseconds defaultDeadline{60'000};
  std::chrono::milliseconds maxDeadline{900'000};
  std::chrono::milliseconds stallTimeout{30'000};  // without progress of an upload or of a stream's reader
};

// Calls in flight.
class CallCount {
 public:
  void begin();
  void end();
  bool waitForNone(std::chrono::steady_clock::time_point until);  // false: some were left

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t count_ = 0;
};

// Shared by all calls; outlives them.
struct CallContext {
  RenderQueue& queue;
  SceneStore& store;
  Timer& timer;
  CallLimits limits;
  std::function<void(const CallRecord&)> onEnd;  // any thread, concurrently; must not throw or wait
  std::function<void(const std::string& why)>
      onBroken;  // once the device has failed kMaxFailures times in a row
  std::string idPrefix;
  std::atomic<std::uint64_t> lastId = 0;
  std::atomic<std::uint64_t> uploadBytes = 0;  // in flight
  std::atomic<unsigned> failures = 0;          // of the device, in a row
  CallCount calls;                             // renderings and uploads
};

// Fills in a record as a call goes on and hands it to onEnd once.
class CallLog {
 public:
  CallLog(CallContext&, const grpc::CallbackServerContext&, std::string rpc);
  CallRecord record;
  void end(const grpc::Status&);

 private:
  CallContext& context_;
  std::chrono::steady_clock::time_point begin_;
};

// Who asks, as far as fairness goes: the certificate's identity, or else the connection. Clients of one unix
// socket count as one.
std::string clientOf(const grpc::CallbackServerContext&);

// When a rendering must be done: what the client says, within the server's limits.
std::chrono::steady_clock::time_point deadlineOf(const grpc::CallbackServerContext&, const CallLimits&);

inline constexpr unsigned kMaxFailures = 3;
inline constexpr const char* kRetryKey = "sundial-retry-ms";
inline constexpr std::size_t kChunkBytes = 256 << 10;

}  // namespace sundial
