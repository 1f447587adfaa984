// A bounded, fair queue in front of the one thread that owns the device. A client takes its turn after every
// other client that waits, so that one with fifty renderings delays another's by one rendering only.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "renderer.h"
#include "result.h"

namespace sundial {

struct QueueLimits {
  std::size_t waiting = 64;          // renderings admitted and not yet begun
  std::size_t waitingPerClient = 8;  // of them, by one client
  std::uint64_t unsentBytes =
      2ull << 30;  // of finished renderings; a rendering that doesn't fit waits its turn
};

class RenderQueue {
  struct Entry;

 public:
  struct Job {
    std::uint64_t outputBytes =
        0;  // held from the rendering's begin until Ticket::sent() or the ticket's end
    std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
    // Exactly one of these is called, once: `run` on the rendering thread, or `refuse` on any thread, when
    // the job ends before its turn. Neither may throw, block on a client, or hold on to the Renderer.
    std::move_only_function<void(Renderer&, const Interrupt&)> run;
    std::move_only_function<void(Error)> refuse;
  };

  // A place in the queue. Any thread; must not outlive the queue.
  class Ticket {
   public:
    Ticket() = default;
    Ticket(Ticket&&) noexcept = default;
    Ticket& operator=(Ticket&&) = delete;
    ~Ticket();  // gives up the place and the output bytes; stops a job that runs, without a call of `refuse`

    // Queues the job, once. Gives the number of renderings ahead of it, that on the device included.
    // Errors: what the ticket was cancelled with, or unavailable after stop(); the job is dropped uncalled.
    Result<std::size_t> enqueue(Job);
    // A waiting job leaves the queue at once and is refused with `why`; one that runs is told to stop and
    // ends before its next pass. Without effect on one that has ended.
    void cancel(Error why);
    std::optional<Error> cancelledWith() const;
    // That many of the job's output bytes are held no more.
    void sent(std::uint64_t bytes);

   private:
    friend class RenderQueue;
    Ticket(RenderQueue* queue, std::shared_ptr<Entry> entry) : queue_(queue), entry_(std::move(entry)) {}
    RenderQueue* queue_ = nullptr;
    std::shared_ptr<Entry> entry_;
  };

  RenderQueue(std::unique_ptr<Renderer>, QueueLimits);
  ~RenderQueue();  // stop()
  RenderQueue(const RenderQueue&) = delete;
  RenderQueue& operator=(const RenderQueue&) = delete;

  // Takes a place, before the job is known. Errors: resourceExhausted when the queue, or this client's share
  // of it, is full; unavailable after drain(). Any thread.
  Result<Ticket> admit(const std::string& client);
  // When a refused client may try again: about as long as a rendering takes.
  std::chrono::milliseconds retryAfter() const;

  void drain();  // admits no more; what was admitted goes on
  void stop();   // drain(); refuses what waits, stops what runs, joins the thread

  struct Counts {
    std::size_t waiting = 0, rendering = 0;
    std::uint64_t unsentBytes = 0;
  };
  Counts counts() const;
  const QueueLimits& limits() const { return limits_; }
  const DeviceInfo& device() const { return device_; }
  std::uint64_t validationMessages() const { return validationMessages_; }  // as of the last rendering's end

 private:
  struct Line {  // of one client
    std::string client;
    std::deque<std::shared_ptr<Entry>> entries;
  };

  void work();
  std::shared_ptr<Entry> takeNext();
  std::size_t aheadOf(const Line&) const;
  void leave(const std::shared_ptr<Entry>&, Error why);
  void giveUp(Entry&);
  std::size_t waitingOf(const std::string& client) const;

  const std::unique_ptr<Renderer> renderer_;
  const DeviceInfo device_;
  const QueueLimits limits_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Line> lines_;                      // clients with jobs queued; the front one's turn is next
  std::map<std::string, std::size_t> waiting_;  // admitted and not begun, by client
  std::size_t waitingTotal_ = 0;
  std::shared_ptr<Entry> running_;
  std::uint64_t unsentBytes_ = 0;
  double secondsPerJob_ = 0.1;  // a moving average
  bool draining_ = false, stopping_ = false;
  std::atomic<std::uint64_t> validationMessages_ = 0;

  std::thread thread_;
};

}  // namespace sundial
