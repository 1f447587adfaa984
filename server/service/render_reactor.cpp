#include "service/render_reactor.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "service/status.h"
#include "sundial/crc32c.h"

namespace sundial {

using Clock = std::chrono::steady_clock;

RenderReactor* RenderReactor::start(CallContext& context, grpc::CallbackServerContext* call,
                                    const v1::RenderRequest& request) {
  auto reactor = std::make_shared<RenderReactor>(context, call);
  reactor->self_ = reactor;
  reactor->begin(request);
  return reactor.get();
}

RenderReactor::RenderReactor(CallContext& context, grpc::CallbackServerContext* call)
    : context_(context),
      call_(call),
      log_(context, *call, "Render"),
      deadline_(deadlineOf(*call, context.limits)) {
  context_.calls.begin();
}

void RenderReactor::begin(const v1::RenderRequest& request) {
  // Refuse what can never work before what can't work now.
  auto spec = fromProto(request, context_.limits.request);
  if (!spec) return end(std::unexpected(std::move(spec.error())));
  log_.record.subject = spec->scene;
  for (const Method& method : spec->job.methods) log_.record.subject.append(" ").append(method.label());

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
  const std::string scene = spec->scene;
  context_.store.load(
      scene, false, stopLoading_.get_token(),
      [self = shared_from_this(), spec = std::move(*spec)](Result<LoadedScene> loaded) mutable {
        self->onScene(std::move(spec), std::move(loaded));
      });
}

void RenderReactor::onScene(RenderSpec spec, Result<LoadedScene> loaded) {
  if (!loaded) return end(std::unexpected(std::move(loaded.error())));
  const std::uint64_t outputBytes = spec.outputBytes;
  auto job = withScene(std::move(spec), loaded->scene);
  if (!job) return end(std::unexpected(std::move(job.error())));

  v1::RenderEvent event;
  v1::Accepted& accepted = *event.mutable_accepted();
  accepted.set_request_id(log_.record.id);
  accepted.set_bytes_expected(outputBytes);
  toProto(job->view, accepted.mutable_view());
  toProto(job->light, accepted.mutable_light());
  accepted.set_scene_digest(loaded->digest);
  accepted.set_device(context_.queue.device().name);
  accepted.set_driver(context_.queue.device().driver);
  {
    // Under the lock, so that nothing of the rendering comes before its acceptance.
    const std::lock_guard lock(mutex_);
    if (status_) return;
    auto ahead = ticket_->enqueue({
        .outputBytes = outputBytes,
        .deadline = deadline_,
        .run = [self = shared_from_this(), job = std::move(*job)](
                   Renderer& renderer,
                   const Interrupt& interrupt) { self->render(job, renderer, interrupt); },
        .refuse = [self = shared_from_this()](Error why) { self->end(std::unexpected(std::move(why))); },
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

void RenderReactor::render(const RenderJob& job, Renderer& renderer, const Interrupt& interrupt) {
  const auto began = Clock::now();
  Result<void> result = [&]() -> Result<void> {
    try {
      return renderer.run(job, interrupt, *this);
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
    v1::RenderEvent done;
    done.mutable_done();
    push(std::move(done));
  }
  end(std::move(result));
}

void RenderReactor::onPlan(std::size_t method, const std::vector<PlanView>& plan) {
  v1::RenderEvent event;
  event.mutable_layout()->set_method(static_cast<std::uint32_t>(method));
  toProto(plan, event.mutable_layout()->mutable_plan());
  push(std::move(event));
}

void RenderReactor::onImage(std::size_t method, Image image) {
  push(Outgoing{static_cast<std::uint32_t>(method), std::move(image)});
}

void RenderReactor::onResult(std::size_t method, MethodResult result) {
  v1::RenderEvent event;
  event.mutable_timings()->set_method(static_cast<std::uint32_t>(method));
  toProto(result, event.mutable_timings()->mutable_result());
  push(std::move(event));
}

void RenderReactor::push(Item item) {
  {
    const std::lock_guard lock(mutex_);
    if (status_) return;  // nobody reads it any more
    items_.push_back(std::move(item));
  }
  pump();
}

void RenderReactor::end(Result<void> result) {
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

void RenderReactor::giveUp(Error why) {
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

void RenderReactor::pump() {
  std::unique_lock lock(mutex_);
  if (writing_ || cancelling_ || finished_) return;
  if (nextEvent()) {
    writing_ = true;
    writeBegan_ = Clock::now();
    lock.unlock();
    StartWrite(&event_);
  } else if (status_) {
    finished_ = true;
    lock.unlock();
    Finish(*status_);
  }
}

bool RenderReactor::nextEvent() {
  if (items_.empty()) return false;
  if (auto* image = std::get_if<Outgoing>(&items_.front())) {
    nextOf(*image);
    if (!event_.has_image_end()) return true;
    ticket_->sent(image->image.bytes.size());
  } else {
    event_ = std::move(std::get<v1::RenderEvent>(items_.front()));
  }
  items_.pop_front();
  return true;
}

void RenderReactor::nextOf(Outgoing& out) {
  const Image& image = out.image;
  switch (out.next) {
    case Outgoing::Next::begin: {
      v1::ImageBegin& to = *event_.mutable_image_begin();
      to.set_method(out.method);
      to.set_aov(toProto(image.aov));
      to.set_width(image.size.x);
      to.set_height(image.size.y);
      to.set_bytes(image.bytes.size());
      out.next = Outgoing::Next::chunk;
      break;
    }
    case Outgoing::Next::chunk: {
      const auto rest = std::span(image.bytes).subspan(out.offset);
      const auto chunk = rest.first(std::min(kChunkBytes, rest.size()));
      event_.mutable_image_chunk()->mutable_data()->assign(reinterpret_cast<const char*>(chunk.data()),
                                                           chunk.size());
      out.checksum = crc32c(chunk, out.checksum);
      out.offset += chunk.size();
      log_.record.bytesSent += chunk.size();
      if (out.offset == image.bytes.size()) out.next = Outgoing::Next::end;
      break;
    }
    case Outgoing::Next::end:
      event_.mutable_image_end()->set_crc32c(out.checksum);
      break;
  }
}

void RenderReactor::OnWriteDone(bool ok) {
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

void RenderReactor::OnCancel() {
  giveUp({ErrorCode::cancelled, "the client went away or its deadline passed"});
}

void RenderReactor::OnDone() {
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
void RenderReactor::arm(Clock::time_point now) {
  const auto stall = context_.limits.stallTimeout;
  auto next = writing_ ? writeBegan_ + stall : now + stall;
  if (deadline_ > now) next = std::min(next, deadline_);
  alarm_ = context_.timer.at(next, [weak = weak_from_this()] {
    if (const auto self = weak.lock()) self->onTime();
  });
}

void RenderReactor::onTime() {
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

}  // namespace sundial
