#include "render_queue.h"

#include <fmt/format.h>

#include <algorithm>

namespace sundial {

// Guarded by the queue's mutex.
struct RenderQueue::Entry {
  enum class State { admitted, queued, running, ended } state = State::admitted;
  std::string client;
  Job job;
  std::stop_source stop;
  std::uint64_t held = 0;  // output bytes
  std::optional<Error> cancelled;
};

RenderQueue::RenderQueue(std::unique_ptr<Renderer> renderer, QueueLimits limits)
    : renderer_(std::move(renderer)), device_(renderer_->device()), limits_(limits) {
  thread_ = std::thread([this] { work(); });
}

RenderQueue::~RenderQueue() { stop(); }

Result<RenderQueue::Ticket> RenderQueue::admit(const std::string& client) {
  const std::lock_guard lock(mutex_);
  if (draining_) return fail(ErrorCode::unavailable, "the server is stopping: ask another, or later");
  if (waitingTotal_ >= limits_.waiting) {
    return fail(ErrorCode::resourceExhausted,
                fmt::format("the queue is full: {} of {} renderings wait; try again later", waitingTotal_,
                            limits_.waiting));
  }
  if (const std::size_t mine = waitingOf(client); mine >= limits_.waitingPerClient) {
    return fail(ErrorCode::resourceExhausted,
                fmt::format("{} of at most {} renderings of this client wait; try again when one has begun",
                            mine, limits_.waitingPerClient));
  }
  auto entry = std::make_shared<Entry>();
  entry->client = client;
  ++waiting_[client];
  ++waitingTotal_;
  return Ticket(this, std::move(entry));
}

std::size_t RenderQueue::waitingOf(const std::string& client) const {
  const auto found = waiting_.find(client);
  return found == waiting_.end() ? 0 : found->second;
}

std::chrono::milliseconds RenderQueue::retryAfter() const {
  const std::lock_guard lock(mutex_);
  return std::chrono::milliseconds(std::clamp(static_cast<int>(secondsPerJob_ * 1000), 50, 10'000));
}

RenderQueue::Counts RenderQueue::counts() const {
  const std::lock_guard lock(mutex_);
  return {waitingTotal_, running_ ? 1u : 0u, unsentBytes_};
}

Result<std::size_t> RenderQueue::Ticket::enqueue(Job job) {
  const std::lock_guard lock(queue_->mutex_);
  if (entry_->cancelled) return std::unexpected(*entry_->cancelled);
  if (queue_->stopping_) return fail(ErrorCode::unavailable, "the server is stopping: ask another, or later");
  entry_->state = Entry::State::queued;
  entry_->job = std::move(job);
  auto line = std::ranges::find(queue_->lines_, entry_->client, &Line::client);
  if (line == queue_->lines_.end()) {
    queue_->lines_.push_back({entry_->client, {}});
    line = queue_->lines_.end() - 1;
  }
  line->entries.push_back(entry_);
  queue_->changed_.notify_all();
  return queue_->aheadOf(*line);
}

// Ahead of the last job of a line: those before it there, as many of every other client, and one more of each
// client whose turn comes sooner.
std::size_t RenderQueue::aheadOf(const Line& mine) const {
  std::size_t ahead = (running_ ? 1 : 0) + mine.entries.size() - 1;
  bool sooner = true;
  for (const Line& line : lines_) {
    if (&line == &mine) {
      sooner = false;
    } else {
      ahead += std::min(line.entries.size(), mine.entries.size() - (sooner ? 0 : 1));
    }
  }
  return ahead;
}

std::optional<Error> RenderQueue::Ticket::cancelledWith() const {
  const std::lock_guard lock(queue_->mutex_);
  return entry_->cancelled;
}

void RenderQueue::Ticket::cancel(Error why) { queue_->leave(entry_, std::move(why)); }

void RenderQueue::leave(const std::shared_ptr<Entry>& entry, Error why) {
  Job dropped;  // its functions are called and destroyed without the lock: they may hold the last reference
  bool wasQueued = false;
  {
    const std::lock_guard lock(mutex_);
    if (entry->cancelled || entry->state == Entry::State::ended) return;
    entry->cancelled = why;
    if (entry->state == Entry::State::running) {
      entry->stop.request_stop();
      return;
    }
    if (entry->state == Entry::State::queued) {
      wasQueued = true;
      dropped = std::move(entry->job);
      const auto line = std::ranges::find(lines_, entry->client, &Line::client);
      std::erase(line->entries, entry);
      if (line->entries.empty()) lines_.erase(line);
    }
    giveUp(*entry);
    entry->state = Entry::State::ended;
  }
  if (wasQueued) dropped.refuse(std::move(why));
}

// The place among those that wait.
void RenderQueue::giveUp(Entry& entry) {
  --waitingTotal_;
  if (const auto found = waiting_.find(entry.client); --found->second == 0) waiting_.erase(found);
}

void RenderQueue::Ticket::sent(std::uint64_t bytes) {
  const std::lock_guard lock(queue_->mutex_);
  bytes = std::min(bytes, entry_->held);
  entry_->held -= bytes;
  queue_->unsentBytes_ -= bytes;
  queue_->changed_.notify_all();
}

RenderQueue::Ticket::~Ticket() {
  if (!entry_) return;
  cancel({ErrorCode::cancelled, "the rendering was given up"});
  sent(UINT64_MAX);
}

// The first client's job whose output fits beside what waits to be sent. Small renderings may pass a large
// one while slow readers hold memory; readers that make no progress are ended, so that can't last.
std::shared_ptr<RenderQueue::Entry> RenderQueue::takeNext() {
  for (auto line = lines_.begin(); line != lines_.end(); ++line) {
    const std::uint64_t bytes = line->entries.front()->job.outputBytes;
    if (unsentBytes_ > 0 && unsentBytes_ + bytes > limits_.unsentBytes) continue;
    std::shared_ptr<Entry> entry = std::move(line->entries.front());
    line->entries.pop_front();
    Line rest = std::move(*line);
    lines_.erase(line);
    if (!rest.entries.empty()) lines_.push_back(std::move(rest));
    return entry;
  }
  return nullptr;
}

void RenderQueue::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    std::shared_ptr<Entry> entry;
    changed_.wait(lock, [&] { return stopping_ || (entry = takeNext()); });
    if (!entry) return;

    giveUp(*entry);
    entry->state = Entry::State::running;
    entry->held = entry->job.outputBytes;
    unsentBytes_ += entry->held;
    running_ = entry;
    Job job = std::move(entry->job);
    const auto deadline = job.deadline;
    const Interrupt interrupt{entry->stop.get_token(), deadline};
    lock.unlock();

    const auto begin = std::chrono::steady_clock::now();
    if (begin >= deadline) {
      job.refuse({ErrorCode::deadlineExceeded, "the deadline passed in the queue: allow more time"});
    } else {
      job.run(*renderer_, interrupt);
    }
    job = {};  // before the slot is free, so that an ended job holds nothing
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    validationMessages_ = renderer_->validationMessages();

    lock.lock();
    if (begin < deadline) secondsPerJob_ += 0.2 * (took.count() - secondsPerJob_);
    entry->state = Entry::State::ended;
    running_ = nullptr;
    // A ticket that ended meanwhile gave its bytes back already; one that lives does when it has sent them.
  }
}

void RenderQueue::drain() {
  const std::lock_guard lock(mutex_);
  draining_ = true;
}

void RenderQueue::stop() {
  const Error why{ErrorCode::unavailable, "the server is stopping: ask another, or later"};
  std::vector<std::shared_ptr<Entry>> all;
  {
    const std::lock_guard lock(mutex_);
    draining_ = stopping_ = true;
    for (const Line& line : lines_) all.insert(all.end(), line.entries.begin(), line.entries.end());
    if (running_) all.push_back(running_);
  }
  for (const auto& entry : all) leave(entry, why);
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

}  // namespace sundial
