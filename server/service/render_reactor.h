// Work of the rendering thread as a stream of events. The thread puts what it makes into a list and goes on;
// this sends it on, one write at a time, as fast as the client reads.
#pragma once

#include <grpcpp/support/server_callback.h>

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <variant>
#include <vector>

#include "service/call.h"
#include "sundial/v1/sundial.pb.h"

namespace sundial {

// Event: a message with accepted, image_chunk, image_end and done, as the contract's streams have.
template <class Event>
class RenderReactor : public grpc::ServerWriteReactor<Event>,
                      public std::enable_shared_from_this<RenderReactor<Event>> {
 public:
  // Of gRPC.
  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 protected:
  RenderReactor(CallContext&, grpc::CallbackServerContext*, std::string rpc);

  // What a request asks of the renderer, once its scene is there.
  struct Work {
    Event accepted;  // what the request settles of it
    std::uint64_t outputBytes = 0;
    std::move_only_function<Result<void>(Renderer&, const Interrupt&)> run;
  };
  using Prepare = std::move_only_function<Result<Work>(const LoadedScene&)>;

  // A call, begun or refused: its request becomes a spec, and with its scene the spec becomes work by the
  // call's prepared(spec, scene).
  template <class Call, class Request>
  static Call* open(CallContext&, grpc::CallbackServerContext*, const Request&);

 private:
  // Owned by the call until gRPC is done with it, and by the work while it runs. One of these follows, once.
  void own(std::shared_ptr<RenderReactor> self) { self_ = std::move(self); }
  void begin(std::string subject, std::string scene, Prepare);
  void refuse(Error why) { end(std::unexpected(std::move(why))); }

 protected:
  // Of the rendering thread.
  void push(Event event) { pushItem(std::move(event)); }
  void push(Event begin, std::vector<std::byte> image) {
    pushItem(Outgoing{std::move(begin), std::move(image)});
  }

  const RequestLimits& limits() const { return context_.limits.request; }

 private:
  struct Outgoing {  // an image, sent as begin, chunks and end
    Event beginning;
    std::vector<std::byte> bytes;
    enum class Next { begin, chunk, end } next = Next::begin;
    std::size_t offset = 0;
    std::uint32_t checksum = 0;
  };
  using Item = std::variant<Event, Outgoing>;

  void onScene(Prepare, Result<LoadedScene>);
  void render(Work&, Renderer&, const Interrupt&);
  void pushItem(Item);
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
  Event event_;  // being written
  bool writing_ = false, cancelling_ = false, finished_ = false;
  std::optional<grpc::Status> status_;
  std::chrono::steady_clock::time_point writeBegan_;
  std::optional<Timer::Id> alarm_;
};

template <class Event>
template <class Call, class Request>
Call* RenderReactor<Event>::open(CallContext& context, grpc::CallbackServerContext* call,
                                 const Request& request) {
  const auto opened = std::make_shared<Call>(context, call);
  RenderReactor& reactor = *opened;
  reactor.own(opened);
  // Refuse what can never work before what can't work now.
  auto spec = fromProto(request, reactor.limits());
  if (!spec) {
    reactor.refuse(std::move(spec.error()));
    return opened.get();
  }
  std::string subject = spec->scene, scene = spec->scene;
  for (const Method& method : spec->job.methods) subject.append(" ").append(method.label());
  reactor.begin(std::move(subject), std::move(scene),
                [self = opened.get(), spec = std::move(*spec)](const LoadedScene& loaded) mutable {
                  return self->prepared(std::move(spec), loaded);
                });
  return opened.get();
}

extern template class RenderReactor<v1::RenderEvent>;
extern template class RenderReactor<v1::StabilityEvent>;

}  // namespace sundial
