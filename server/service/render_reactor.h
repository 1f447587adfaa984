// One rendering as a stream of events. The rendering thread puts what it makes into a list and goes on; this
// sends it on, one write at a time, as fast as the client reads.
#pragma once

#include <grpcpp/support/server_callback.h>

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <variant>

#include "service/call.h"
#include "sundial/v1/sundial.pb.h"

namespace sundial {

class RenderReactor final : public grpc::ServerWriteReactor<v1::RenderEvent>,
                            public JobSink,
                            public std::enable_shared_from_this<RenderReactor> {
 public:
  // Owned by the call until gRPC is done with it, and by the rendering while it runs.
  static RenderReactor* start(CallContext&, grpc::CallbackServerContext*, const v1::RenderRequest&);

  RenderReactor(CallContext&, grpc::CallbackServerContext*);

  // Of gRPC.
  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

  // Of the rendering thread.
  void onPlan(std::size_t method, const std::vector<PlanView>&) override;
  void onImage(std::size_t method, Image) override;
  void onResult(std::size_t method, MethodResult) override;

 private:
  struct Outgoing {  // an image, sent as begin, chunks and end
    std::uint32_t method;
    Image image;
    enum class Next { begin, chunk, end } next = Next::begin;
    std::size_t offset = 0;
    std::uint32_t checksum = 0;
  };
  using Item = std::variant<v1::RenderEvent, Outgoing>;

  void begin(const v1::RenderRequest&);
  void onScene(RenderSpec, Result<LoadedScene>);
  void render(const RenderJob&, Renderer&, const Interrupt&);
  void push(Item);
  void giveUp(Error);      // stops the work and ends the call
  void end(Result<void>);  // ends the call once all events are sent, or at once with an error
  void pump();             // sends the next event, or the status
  bool nextEvent();        // into event_; needs the lock
  void nextOf(Outgoing&);  // the same
  void arm(std::chrono::steady_clock::time_point now);
  void onTime();

  CallContext& context_;
  grpc::CallbackServerContext* const call_;
  CallLog log_;
  std::shared_ptr<RenderReactor> self_;
  const std::chrono::steady_clock::time_point deadline_;

  std::mutex
      mutex_;  // guards what follows; may be held while the queue's is taken, never the other way round
  std::stop_source stopLoading_;
  std::optional<RenderQueue::Ticket> ticket_;  // set once, at the beginning
  std::deque<Item> items_;
  v1::RenderEvent event_;  // being written
  bool writing_ = false, cancelling_ = false, finished_ = false;
  std::optional<grpc::Status> status_;
  std::chrono::steady_clock::time_point writeBegan_;
  std::optional<Timer::Id> alarm_;
};

}  // namespace sundial
