// The queue: bounded, fair, cancellable at any point, one thread.
#include "render_queue.h"

#include <gtest/gtest.h>

#include <future>

#include "support/fake_renderer.h"

namespace sundial {
namespace {

using test::Gate;

class RenderQueueTest : public ::testing::Test {
 protected:
  ~RenderQueueTest() override { gate.open(); }

  void start() {
    queue = std::make_unique<RenderQueue>(
        std::make_unique<test::FakeRenderer>(std::make_shared<test::FakeState>()), limits);
  }
  // Jobs note their name when they run, and the code when they are refused; they hold the thread at the gate.
  RenderQueue::Job job(std::string name, std::uint64_t bytes = 0) {
    return {.outputBytes = bytes,
            .run =
                [this, name](Renderer&, const Interrupt& interrupt) {
                  gate.arrive();
                  note(interrupt.raised() ? name + " stopped" : name);
                },
            .refuse = [this, name](Error why) { note(name + " refused: " + why.message); }};
  }
  RenderQueue::Ticket& submit(const std::string& client, std::string name, std::uint64_t bytes = 0) {
    auto ticket = queue->admit(client);
    EXPECT_TRUE(ticket);
    tickets.push_back(std::move(*ticket));
    const auto ahead = tickets.back().enqueue(job(std::move(name), bytes));
    EXPECT_TRUE(ahead);
    lastAhead = ahead.value_or(999);
    return tickets.back();
  }
  // A rendering that holds the thread.
  RenderQueue::Ticket& block() {
    gate.close();
    RenderQueue::Ticket& ticket = submit("blocker", "blocker");
    gate.awaitArrivals(1);
    return ticket;
  }
  void note(std::string what) {
    const std::lock_guard lock(mutex);
    notes.push_back(std::move(what));
    changed.notify_all();
  }
  std::vector<std::string> await(std::size_t count) {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return notes.size() >= count; });
    return notes;
  }

  Gate gate;
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::string> notes;
  QueueLimits limits{.waiting = 10, .waitingPerClient = 5, .unsentBytes = 100};
  std::unique_ptr<RenderQueue> queue;
  std::deque<RenderQueue::Ticket> tickets;  // end before the queue
  std::size_t lastAhead = 0;
};

using Notes = std::vector<std::string>;

TEST_F(RenderQueueTest, ClientsTakeTurns) {
  start();
  block();
  for (const char* name : {"a1", "a2", "a3"}) submit("a", name);
  submit("b", "b1");
  submit("c", "c1");
  submit("b", "b2");
  gate.open();
  EXPECT_EQ(await(7), (Notes{"blocker", "a1", "b1", "c1", "a2", "b2", "a3"}));
}

TEST_F(RenderQueueTest, PositionCountsThoseAhead) {
  start();
  block();
  submit("a", "a1");
  EXPECT_EQ(lastAhead, 1u);  // the blocker
  submit("a", "a2");
  EXPECT_EQ(lastAhead, 2u);
  submit("a", "a3");
  EXPECT_EQ(lastAhead, 3u);
  submit("b", "b1");
  EXPECT_EQ(lastAhead, 2u);  // blocker, a1
  submit("b", "b2");
  EXPECT_EQ(lastAhead, 4u);  // blocker, a1, b1, a2
  gate.open();
  await(6);
}

TEST_F(RenderQueueTest, FullQueueRefuses) {
  limits = {.waiting = 3, .waitingPerClient = 2};
  start();
  block();
  submit("a", "a1");
  submit("a", "a2");
  const auto mine = queue->admit("a");
  ASSERT_FALSE(mine);
  EXPECT_EQ(mine.error().code, ErrorCode::resourceExhausted);
  EXPECT_NE(mine.error().message.find("2 of at most 2"), std::string::npos) << mine.error().message;
  submit("b", "b1");
  const auto any = queue->admit("c");
  ASSERT_FALSE(any);
  EXPECT_EQ(any.error().code, ErrorCode::resourceExhausted);
  EXPECT_NE(any.error().message.find("3 of 3"), std::string::npos) << any.error().message;
  EXPECT_GE(queue->retryAfter().count(), 1);
}

TEST_F(RenderQueueTest, CancelledInTheQueueFreesItsPlaceAtOnce) {
  limits = {.waiting = 2, .waitingPerClient = 2};
  start();
  block();
  RenderQueue::Ticket& first = submit("a", "a1");
  submit("a", "a2");
  ASSERT_FALSE(queue->admit("b"));
  first.cancel({ErrorCode::cancelled, "gone"});
  EXPECT_EQ(await(1), (Notes{"a1 refused: gone"}));  // on this thread, while the blocker runs
  EXPECT_TRUE(queue->admit("b"));
  gate.open();
  EXPECT_EQ(await(3), (Notes{"a1 refused: gone", "blocker", "a2"}));
}

TEST_F(RenderQueueTest, CancelledWhileItRunsIsToldToStop) {
  start();
  RenderQueue::Ticket& running = block();
  submit("a", "a1");
  running.cancel({ErrorCode::unavailable, "stopping"});
  EXPECT_EQ(running.cancelledWith()->message, "stopping");
  gate.open();
  EXPECT_EQ(await(2), (Notes{"blocker stopped", "a1"}));
}

TEST_F(RenderQueueTest, CancelledBeforeItIsQueuedNeverRuns) {
  limits = {.waiting = 1, .waitingPerClient = 1};
  start();
  auto ticket = queue->admit("a");
  ASSERT_TRUE(ticket);
  EXPECT_FALSE(queue->admit("b"));
  ticket->cancel({ErrorCode::deadlineExceeded, "late"});
  EXPECT_TRUE(queue->admit("b"));
  const auto ahead = ticket->enqueue(job("a1"));
  ASSERT_FALSE(ahead);
  EXPECT_EQ(ahead.error().code, ErrorCode::deadlineExceeded);
}

TEST_F(RenderQueueTest, TicketsThatEndGiveTheirPlaceBack) {
  limits = {.waiting = 1, .waitingPerClient = 1};
  start();
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(queue->admit("a"));
  EXPECT_EQ(queue->counts().waiting, 0u);
}

TEST_F(RenderQueueTest, PassedDeadlineIsRefusedAtItsTurn) {
  start();
  block();
  auto ticket = queue->admit("a");
  RenderQueue::Job late = job("late");
  late.deadline = std::chrono::steady_clock::now();
  ASSERT_TRUE(ticket->enqueue(std::move(late)));
  gate.open();
  const Notes all = await(2);
  EXPECT_EQ(all[0], "blocker");
  EXPECT_TRUE(all[1].starts_with("late refused: the deadline")) << all[1];
}

TEST_F(RenderQueueTest, LargeOutputWaitsUntilReadersHaveTakenTheirs) {
  start();
  RenderQueue::Ticket& unsent = submit("a", "a1", 80);
  await(1);
  submit("b", "b1", 30);  // 110 bytes are too many
  submit("c", "c1", 20);
  EXPECT_EQ(await(2), (Notes{"a1", "c1"}));
  EXPECT_EQ(queue->counts().unsentBytes, 100u);
  unsent.sent(30);
  EXPECT_EQ(await(3), (Notes{"a1", "c1", "b1"}));
}

TEST_F(RenderQueueTest, OutputOverTheLimitRunsAlone) {
  start();
  submit("a", "a1", 1000);
  EXPECT_EQ(await(1), (Notes{"a1"}));
  EXPECT_EQ(queue->counts().unsentBytes, 1000u);
  tickets.clear();
  EXPECT_EQ(queue->counts().unsentBytes, 0u);
}

TEST_F(RenderQueueTest, DrainingFinishesWhatWasAdmitted) {
  start();
  block();
  auto admitted = queue->admit("a");
  submit("a", "a1");
  queue->drain();
  const auto refused = queue->admit("b");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::unavailable);
  EXPECT_TRUE(admitted->enqueue(job("a2")));
  gate.open();
  EXPECT_EQ(await(3), (Notes{"blocker", "a1", "a2"}));
}

TEST_F(RenderQueueTest, StoppingRefusesWhatWaitsAndStopsWhatRuns) {
  start();
  block();
  submit("a", "a1");
  auto stopped = std::async(std::launch::async, [&] { queue->stop(); });
  await(1);  // a1 is refused while the blocker still runs
  gate.open();
  stopped.get();
  const Notes all = await(2);
  EXPECT_TRUE(all[0].starts_with("a1 refused: the server is stopping")) << all[0];
  // The running one is told after those that wait; by then it may have been let through.
  EXPECT_TRUE(all[1].starts_with("blocker")) << all[1];
}

}  // namespace
}  // namespace sundial
