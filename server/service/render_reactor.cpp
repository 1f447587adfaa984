#include "service/render_reactor.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "service/status.h"
#include "sundial/crc32c.h"

namespace sundial {

using Clock = std::chrono::steady_clock;

template <class Event>
RenderReactor<Event>::RenderReactor(CallContext& context, grpc::CallbackServerContext* call, std::string rpc)
    : context_(context),
      call_(call),
      log_(context, *call, std::move(rpc)),
      deadline_(deadlineOf(*call, context.limits)) {
  context_.calls.begin();
}

template <class Event>
void RenderReactor<Event>::begin(std::string subject, std::string scene, Prepare prepare) {
  log_.record.subject = std::move(subject);
  auto ticket = context_.queue.admit(log_.record.client);
  if (!ticket) {
    if (ticket.error().code == ErrorCode::resourceExhausted) {
      call_->AddTrailingMetadata(kRetryKey, fmt::format("{}", context_.queue.retryAfter().count()));
    }
    return end(std::unexpected(std::move(ticket.error())));
  }
  {
    const std::lock_guard lock(mutex_);
    ticket_.emplace(std::move(*ticket));
    arm(Clock::now());
  }
  context_.store.load(
      scene, false, stopLoading_.get_token(),
      [self = this->shared_from_this(), prepare = std::move(prepare)](Result<LoadedScene> loaded) mutable {
        self->onScene(std::move(prepare), std::move(loaded));
      });
}

template <class Event>
void RenderReactor<Event>::onScene(Prepare prepare, Result<LoadedScene> loaded) {
  if (!loaded) return end(std::unexpected(std::move(loaded.error())));
  auto work = prepare(*loaded);
  if (!work) return end(std::unexpected(std::move(work.error())));

  Event event = std::move(work->accepted);
  v1::Accepted& accepted = *event.mutable_accepted();
  accepted.set_request_id(log_.record.id);
  accepted.set_bytes_expected(work->outputBytes);
  accepted.set_scene_digest(loaded->digest);
  accepted.set_device(context_.queue.device().name);
  accepted.set_driver(context_.queue.device().driver);
  {
    // Under the lock, so that nothing of the rendering comes before its acceptance.
    const std::lock_guard lock(mutex_);
    if (status_) return;
    auto ahead = ticket_->enqueue({
        .outputBytes = work->outputBytes,
        .deadline = deadline_,
        .run = [self = this->shared_from_this(), work = std::move(*work)](
                   Renderer& renderer,
                   const Interrupt& interrupt) mutable { self->render(work, renderer, interrupt); },
        .refuse = [self =
                       this->shared_from_this()](Error why) { self->end(std::unexpected(std::move(why))); },
    });
    if (!ahead) {
      status_ = toStatus(ahead.error());
    } else {
      accepted.set_queue_position(static_cast<std::uint32_t>(*ahead));
      items_.emplace_front(std::move(event));
    }
  }
  pump();
}

template <class Event>
void RenderReactor<Event>::render(Work& work, Renderer& renderer, const Interrupt& interrupt) {
  const auto began = Clock::now();
  Result<void> result = [&]() -> Result<void> {
    try {
      return work.run(renderer, interrupt);
    } catch (const std::bad_alloc&) {
      return fail(ErrorCode::resourceExhausted,
                  "the rendering needs more memory than the server has: ask for less");
    } catch (const std::exception& broken) {
      return fail(ErrorCode::unavailable, fmt::format("the device failed: {}", broken.what()));
    }
  }();
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - began).count();
  if (result) {
    context_.failures = 0;
  } else if (result.error().code == ErrorCode::unavailable && ++context_.failures == kMaxFailures &&
             context_.onBroken) {
    context_.onBroken(result.error().message);
  }
  if (!result && result.error().code == ErrorCode::cancelled) {
    if (auto why = ticket_->cancelledWith()) result = std::unexpected(std::move(*why));
  }
  {
    const std::lock_guard lock(mutex_);
    log_.record.renderMs = ms;
  }
  if (result) {
    Event done;
    done.mutable_done();
    push(std::move(done));
  }
  end(std::move(result));
}

template <class Event>
void RenderReactor<Event>::pushItem(Item item) {
  {
    const std::lock_guard lock(mutex_);
    if (status_) return;  // nobody reads it any more
    items_.push_back(std::move(item));
  }
  pump();
}

template <class Event>
void RenderReactor<Event>::end(Result<void> result) {
  std::deque<Item> dropped;  // images are freed without the lock
  {
    const std::lock_guard lock(mutex_);
    if (finished_) return;
    // The first error counts, and comes before a good end whose events aren't all sent. A stream that ends in
    // an error is incomplete, whatever has been sent of it.
    if (!status_ || (status_->ok() && !result))
      status_ = result ? grpc::Status::OK : toStatus(result.error());
    if (!result) dropped.swap(items_);
  }
  pump();
}

template <class Event>
void RenderReactor<Event>::giveUp(Error why) {
  RenderQueue::Ticket* ticket = nullptr;
  std::stop_source loading;
  {
    const std::lock_guard lock(mutex_);
    loading = stopLoading_;
    if (ticket_) ticket = &*ticket_;
  }
  // The work stops before anybody hears that the call has ended.
  loading.request_stop();
  if (ticket) ticket->cancel(why);
  end(std::unexpected(std::move(why)));
}

template <class Event>
void RenderReactor<Event>::pump() {
  std::unique_lock lock(mutex_);
  if (writing_ || cancelling_ || finished_) return;
  if (nextEvent()) {
    writing_ = true;
    writeBegan_ = Clock::now();
    lock.unlock();
    this->StartWrite(&event_);
  } else if (status_) {
    finished_ = true;
    lock.unlock();
    this->Finish(*status_);
  }
}

template <class Event>
bool RenderReactor<Event>::nextEvent() {
  if (items_.empty()) return false;
  if (auto* image = std::get_if<Outgoing>(&items_.front())) {
    nextOf(*image);
    if (!event_.has_image_end()) return true;
    ticket_->sent(image->bytes.size());
  } else {
    event_ = std::move(std::get<Event>(items_.front()));
  }
  items_.pop_front();
  return true;
}

template <class Event>
void RenderReactor<Event>::nextOf(Outgoing& out) {
  switch (out.next) {
    case Outgoing::Next::begin:
      event_ = std::move(out.beginning);
      out.next = Outgoing::Next::chunk;
      break;
    case Outgoing::Next::chunk: {
      const auto rest = std::span(out.bytes).subspan(out.offset);
      const auto chunk = rest.first(std::min(kChunkBytes, rest.size()));
      event_.mutable_image_chunk()->mutable_data()->assign(reinterpret_cast<const char*>(chunk.data()),
                                                           chunk.size());
      out.checksum = crc32c(chunk, out.checksum);
      out.offset += chunk.size();
      log_.record.bytesSent += chunk.size();
      if (out.offset == out.bytes.size()) out.next = Outgoing::Next::end;
      break;
    }
    case Outgoing::Next::end:
      event_.mutable_image_end()->set_crc32c(out.checksum);
      break;
  }
}

template <class Event>
void RenderReactor<Event>::OnWriteDone(bool ok) {
  {
    const std::lock_guard lock(mutex_);
    writing_ = false;
  }
  if (ok) {
    pump();
  } else {
    giveUp({ErrorCode::cancelled, "the client went away"});
  }
}

template <class Event>
void RenderReactor<Event>::OnCancel() {
  giveUp({ErrorCode::cancelled, "the client went away or its deadline passed"});
}

template <class Event>
void RenderReactor<Event>::OnDone() {
  {
    const std::lock_guard lock(mutex_);
    if (alarm_) context_.timer.forget(*alarm_);
    alarm_.reset();
    log_.end(*status_);
  }
  CallContext& context = context_;
  self_.reset();  // the last reference, unless the rendering has yet to notice that it is to stop
  context.calls.end();
}

// The next time at which something may be overdue.
template <class Event>
void RenderReactor<Event>::arm(Clock::time_point now) {
  const auto stall = context_.limits.stallTimeout;
  auto next = writing_ ? writeBegan_ + stall : now + stall;
  if (deadline_ > now) next = std::min(next, deadline_);
  alarm_ = context_.timer.at(next, [weak = this->weak_from_this()] {
    if (const auto self = weak.lock()) self->onTime();
  });
}

template <class Event>
void RenderReactor<Event>::onTime() {
  const auto now = Clock::now();
  bool stalled = false;
  {
    const std::lock_guard lock(mutex_);
    if (finished_) return;
    stalled = writing_ && now >= writeBegan_ + context_.limits.stallTimeout;
    if (stalled) cancelling_ = true;  // keeps the call from ending until TryCancel has returned
    if (!stalled) arm(now);
  }
  if (stalled) {
    end(fail(ErrorCode::deadlineExceeded, "the client read nothing for too long"));
    call_->TryCancel();  // a write in flight ends by nothing else
    {
      const std::lock_guard lock(mutex_);
      cancelling_ = false;
    }
    giveUp({ErrorCode::cancelled, "the client read nothing for too long"});
  } else if (now >= deadline_) {
    giveUp({ErrorCode::deadlineExceeded, "the deadline passed: allow more time, or ask for less"});
  }
}

template class RenderReactor<v1::RenderEvent>;
template class RenderReactor<v1::StabilityEvent>;

}  // namespace sundial
