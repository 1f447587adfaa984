// Cancelling, deadlines, the queue and what a slow reader may hold back.
#include <gtest/gtest.h>

#include "service/server.h"
#include "support/test_server.h"

namespace sundial {
namespace {

using namespace test;
using std::chrono::milliseconds;

constexpr const char* kWholeOrder = "accepted layout image_begin image_chunk image_end timings done";

TEST_F(ServiceTest, CancelledRenderingEndsBeforeItsNextPassWhereverItIs) {
  start();
  v1::RenderRequest two = renderRequest();
  two.add_methods()->set_name("dv");
  unsigned ended = 0, ran = 0;
  for (unsigned pass = 0; pass < 2 * FakeState::kPasses; ++pass) {
    renderer->gate.close();
    const unsigned before = renderer->gate.arrived();
    Stream stream(*stub, two);
    for (unsigned i = 0; i < pass; ++i) renderer->gate.letOneThrough();
    renderer->gate.awaitArrivals(before + pass + 1);  // `pass` passes ran; the next one is about to
    ran += pass;
    ASSERT_EQ(renderer->passesRun, ran);
    stream.context.TryCancel();
    EXPECT_EQ(stream.finish().error_code(), grpc::StatusCode::CANCELLED);
    EXPECT_EQ(records.await("Render", ++ended).status, grpc::StatusCode::CANCELLED);

    renderer->gate.open();
    Stream next(*stub, renderRequest());  // by the slot that the cancelled one left
    EXPECT_TRUE(next.finish().ok());
    EXPECT_EQ(next.order(), kWholeOrder);
    records.await("Render", ++ended);
    ran += FakeState::kPasses;
    ASSERT_EQ(renderer->passesRun, ran) << "the cancelled rendering went on after pass " << pass;
  }
}

TEST_F(ServiceTest, CancelledInTheQueueNeverBegins) {
  options.queue = {.waiting = 1, .waitingPerClient = 1};
  start();
  renderer->gate.close();
  Stream running(*stub, renderRequest());
  renderer->gate.awaitArrivals(1);
  Stream waiting(*stub, renderRequest(7, 7));
  ASSERT_TRUE(waiting.read());
  EXPECT_EQ(waiting.events[0].accepted().queue_position(), 1u);
  EXPECT_EQ(render(renderRequest()).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  waiting.context.TryCancel();
  records.await("Render", 2);
  Stream next(*stub, renderRequest(5, 5));  // its place is free while the first one still runs
  ASSERT_TRUE(next.read());
  renderer->gate.open();
  EXPECT_TRUE(running.finish().ok());
  EXPECT_TRUE(next.finish().ok());
  EXPECT_EQ(renderer->order(), (std::vector<glm::uvec2>{{4, 2}, {5, 5}}));
}

TEST_F(ServiceTest, FullQueueRefusesWithATimeToRetry) {
  options.queue = {.waiting = 3, .waitingPerClient = 2};
  start();
  renderer->gate.close();
  Stream running(*stub, renderRequest());
  renderer->gate.awaitArrivals(1);
  Stream first(*stub, renderRequest()), second(*stub, renderRequest());
  ASSERT_TRUE(first.read() && second.read());

  Stream mine(*stub, renderRequest());
  const grpc::Status share = mine.finish();
  EXPECT_EQ(share.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NE(share.error_message().find("of this client"), std::string::npos) << share.error_message();
  const auto& trailing = mine.context.GetServerTrailingMetadata();
  const auto retry = trailing.find("sundial-retry-ms");
  ASSERT_NE(retry, trailing.end());
  EXPECT_GT(std::stoi(std::string(retry->second.data(), retry->second.size())), 0);

  const auto other = client();
  Stream third(*other, renderRequest());
  ASSERT_TRUE(third.read());
  const auto another = client();
  const grpc::Status full = Stream(*another, renderRequest()).finish();
  EXPECT_EQ(full.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_NE(full.error_message().find("queue is full"), std::string::npos) << full.error_message();

  renderer->gate.open();
  for (Stream* stream : {&running, &first, &second, &third}) EXPECT_TRUE(stream->finish().ok());
}

TEST_F(ServiceTest, ClientsTakeTurns) {
  start();
  renderer->gate.close();
  Stream running(*stub, renderRequest(1, 1));
  renderer->gate.awaitArrivals(1);
  const auto other = client();
  std::deque<Stream> streams;
  for (const auto& [who, side] :
       {std::pair{stub.get(), 2u}, {stub.get(), 3u}, {stub.get(), 4u}, {other.get(), 5u}}) {
    streams.emplace_back(*who, renderRequest(side, side));
    ASSERT_TRUE(streams.back().read());
  }
  EXPECT_EQ(streams.back().events[0].accepted().queue_position(), 2u);
  renderer->gate.open();
  for (Stream& stream : streams) EXPECT_TRUE(stream.finish().ok());
  EXPECT_TRUE(running.finish().ok());
  EXPECT_EQ(renderer->order(), (std::vector<glm::uvec2>{{1, 1}, {2, 2}, {5, 5}, {3, 3}, {4, 4}}));
}

TEST_F(ServiceTest, ClientsDeadlineStopsTheWork) {
  start();
  renderer->gate.close();
  Stream stream(*stub, renderRequest(), milliseconds(100));
  EXPECT_EQ(stream.finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  records.await("Render", 1);
  renderer->gate.open();
  EXPECT_TRUE(render(renderRequest()).ok());
  EXPECT_EQ(renderer->jobsDone, 1u);
  EXPECT_EQ(renderer->passesRun, FakeState::kPasses);
}

TEST_F(ServiceTest, ServersDeadlineEndsThoseThatRunAndThoseThatWait) {
  options.calls.maxDeadline = milliseconds(100);
  start();
  renderer->gate.close();
  Stream running(*stub, renderRequest());
  Stream waiting(*stub, renderRequest());
  for (Stream* stream : {&running, &waiting}) {
    const grpc::Status status = stream->finish();
    EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
    EXPECT_NE(status.error_message().find("allow more time"), std::string::npos) << status.error_message();
  }
  renderer->gate.open();
  server->stop(milliseconds(0));
  EXPECT_LE(renderer->jobsBegun, 1u);
  EXPECT_EQ(renderer->passesRun, 0u);
}

TEST_F(ServiceTest, ReaderThatStopsIsEnded) {
  options.calls.stallTimeout = milliseconds(300);
  start();
  v1::RenderRequest request = renderRequest(4096, 4096);  // 64 MiB: more than gRPC takes off our hands
  const auto idle = client();
  Stream stalled(*idle, request);
  const CallRecord record = records.await("Render", 1);
  EXPECT_EQ(record.status, grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_LT(record.bytesSent, 64u << 20);
  EXPECT_FALSE(stalled.finish().ok());
  EXPECT_TRUE(render(renderRequest()).ok());
  server->stop(milliseconds(0));
  EXPECT_EQ(server->queue().counts().unsentBytes, 0u);
}

TEST_F(ServiceTest, UnsentImagesHoldBackLargeRenderingsOnly) {
  options.queue.unsentBytes = 70 << 20;
  start();
  const auto slow = client();
  Stream unread(*slow, renderRequest(4096, 4096));  // 64 MiB that nobody reads yet
  renderer->gate.awaitArrivals(FakeState::kPasses);
  Stream large(*stub, renderRequest(2048, 2048));  // 16 MiB more: too much
  ASSERT_TRUE(large.read());
  Stream small(*stub, renderRequest());
  // A client's renderings keep their order, so a third client is the one that may pass.
  const auto other = client();
  EXPECT_TRUE(Stream(*other, renderRequest(8, 8)).finish().ok());
  EXPECT_EQ(renderer->order().size(), 2u);
  EXPECT_TRUE(unread.finish().ok());
  EXPECT_TRUE(large.finish().ok());
  EXPECT_TRUE(small.finish().ok());
}

}  // namespace
}  // namespace sundial
