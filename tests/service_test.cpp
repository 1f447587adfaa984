// The service over real gRPC on a local port, with a fake renderer whose passes the tests hold and let go.
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <future>
#include <span>

#include "service/server.h"
#include "sundial/crc32c.h"
#include "support/test_server.h"

namespace sundial {
namespace {

using namespace test;
using std::chrono::milliseconds;

constexpr const char* kWholeOrder = "accepted layout image_begin image_chunk image_end timings done";

std::uint32_t checksum(const std::string& bytes) { return crc32c(std::as_bytes(std::span(bytes))); }

std::string bytesOf(const Image& image) {
  return {reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size()};
}

// --- Rendering

TEST_F(ServiceTest, EventsComeInOrder) {
  start();
  v1::RenderRequest request = renderRequest();
  request.add_methods()->set_name("dv");
  request.add_images(v1::ID);
  Stream stream(*stub, request);
  ASSERT_TRUE(stream.finish().ok());
  EXPECT_EQ(stream.order(),
            "accepted "
            "layout image_begin image_chunk image_end image_begin image_chunk image_end timings "
            "layout image_begin image_chunk image_end image_begin image_chunk image_end timings done");
  const v1::Accepted& accepted = stream.events[0].accepted();
  EXPECT_EQ(accepted.bytes_expected(), 2u * (4 + 8) * 4 * 2);
  EXPECT_EQ(accepted.scene_digest().size(), 64u);
  EXPECT_EQ(accepted.queue_position(), 0u);
  EXPECT_EQ(records.await("Render", 1).id, accepted.request_id());
  EXPECT_EQ(stream.events[1].layout().method(), 0u);
  EXPECT_EQ(stream.events[9].layout().method(), 1u);
  EXPECT_EQ(stream.events[5].image_begin().aov(), v1::ID);
}

TEST_F(ServiceTest, ImagesComeInChunksThatTheirChecksumCovers) {
  start();
  v1::RenderRequest request = renderRequest(600, 300);  // 720,000 bytes: two whole chunks and a rest
  Stream stream(*stub, request);
  ASSERT_TRUE(stream.finish().ok());
  EXPECT_EQ(stream.order(),
            "accepted layout image_begin image_chunk image_chunk image_chunk image_end timings done");
  EXPECT_EQ(stream.events[3].image_chunk().data().size(), 262'144u);
  EXPECT_EQ(stream.events[2].image_begin().bytes(), 720'000u);
  const std::string expected = bytesOf(fakeImage(0, Aov::visibility, {600, 300}));
  EXPECT_TRUE(stream.images().at(0) == expected);
  EXPECT_EQ(stream.events[6].image_end().crc32c(), checksum(expected));
  EXPECT_EQ(records.await("Render", 1).bytesSent, 720'000u);
}

TEST_F(ServiceTest, PlanAndResultsAreToldWhole) {
  start();
  v1::RenderRequest request = renderRequest();
  (*request.mutable_methods(0)->mutable_parameters())["texels"] = "512";
  request.mutable_baseline()->set_name("sm");
  request.set_measures(true);
  Stream stream(*stub, request);
  ASSERT_TRUE(stream.finish().ok());
  const v1::PlanView& view = stream.events[1].layout().plan().views(0);
  ASSERT_EQ(view.shadow_from_world_size(), 16);
  for (int i = 0; i < 16; ++i) EXPECT_EQ(view.shadow_from_world(i), 10 * (i / 4) + i % 4) << i;
  EXPECT_EQ(std::vector<std::uint32_t>(view.rect().begin(), view.rect().end()),
            (std::vector<std::uint32_t>{1, 2, 3, 4}));
  EXPECT_EQ(view.texel_size(), 0.5);
  EXPECT_EQ(view.near(), 1);
  EXPECT_EQ(view.far(), 9);
  EXPECT_EQ(view.depth_begin(), 2);
  EXPECT_EQ(view.depth_end(), 5);
  EXPECT_EQ(view.linear_offset(), 6u);
  EXPECT_EQ(std::vector<std::uint32_t>(view.tile().begin(), view.tile().end()),
            (std::vector<std::uint32_t>{7, 8}));
  const v1::Result& result = stream.events[5].timings().result();
  EXPECT_EQ(result.method(), "sm");
  EXPECT_EQ(result.parameters().at("texels"), "512");
  EXPECT_EQ(result.frame_ms(), 2);
  EXPECT_EQ(result.ratio_to_baseline(), 1);
  EXPECT_EQ(result.ratio_quartiles(1), 2);
  EXPECT_EQ(result.measures().pixel_match(), 1);
  EXPECT_EQ(result.measures().allocated_bytes(), 13);
  EXPECT_EQ(result.passes(0).gpu_ms(), 5);
  EXPECT_EQ(result.passes(0).work().at("vertices"), 7);
  EXPECT_EQ(result.plan().views_size(), 1);
}

TEST_F(ServiceTest, SameRequestGivesSameBytes) {
  start();
  Stream first(*stub, renderRequest(64, 64)), second(*client(), renderRequest(64, 64));
  ASSERT_TRUE(first.finish().ok() && second.finish().ok());
  EXPECT_EQ(first.images(), second.images());
}

TEST_F(ServiceTest, TwoClientsAtOnce) {
  start();
  const auto many = [&](std::unique_ptr<v1::Sundial::Stub> mine) {
    for (int i = 0; i < 20; ++i) {
      Stream stream(*mine, renderRequest(300, 300));
      if (!stream.finish().ok() ||
          checksum(stream.images().at(0)) != stream.events.at(5).image_end().crc32c())
        return i;
    }
    return 20;
  };
  auto one = std::async(std::launch::async, many, client());
  auto two = std::async(std::launch::async, many, client());
  EXPECT_EQ(one.get(), 20);
  EXPECT_EQ(two.get(), 20);
}

TEST_F(ServiceTest, NamedViewsAndLightsAndTheirDefaults) {
  start();
  v1::RenderRequest request = renderRequest();
  Stream first(*stub, request);
  ASSERT_TRUE(first.finish().ok());
  EXPECT_EQ(first.events[0].accepted().view().target().z(), -1);  // "near", the scene's first
  EXPECT_EQ(first.events[0].accepted().light().sun().direction().y(), -1);

  request.set_view_name("far");
  request.set_light_name("lamp");
  Stream second(*stub, request);
  ASSERT_TRUE(second.finish().ok());
  EXPECT_EQ(second.events[0].accepted().view().eye().z(), 100);
  EXPECT_EQ(second.events[0].accepted().light().point().position().z(), 3);

  request.set_view_name("nowhere");
  const grpc::Status noView = render(request);
  EXPECT_EQ(noView.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(noView.error_message(), "the scene has no view 'nowhere': it has near, far");
  request.set_view_name("far");
  request.set_light_name("dusk");
  EXPECT_EQ(render(request).error_message(), "the scene has no light 'dusk': it has noon, lamp");
}

TEST_F(ServiceTest, BadRequestsAreRefusedByName) {
  options.calls.request = {.imageSide = 4096, .outputBytes = 1 << 20};
  start();
  struct Case {
    const char* expected;  // part of the message
    std::function<void(v1::RenderRequest&)> spoil;
    grpc::StatusCode code = grpc::StatusCode::INVALID_ARGUMENT;
  };
  const auto view = [](v1::RenderRequest& r) {
    v1::View* v = r.mutable_view();
    v->mutable_target()->set_z(-1);
    v->set_vertical_fov_degrees(50);
    return v;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Case cases[] = {
      {"scene has 0 bytes", [](auto& r) { r.clear_scene(); }},
      {"scene has 5000 bytes", [](auto& r) { r.set_scene(std::string(5000, 'x')); }},
      {"no built-in scene", [](auto& r) { r.set_scene("builtin:none"); }, grpc::StatusCode::NOT_FOUND},
      {"no scene 'a.glb'", [](auto& r) { r.set_scene("a.glb"); }, grpc::StatusCode::NOT_FOUND},
      {"width is 0: must lie in [1, 4096]", [](auto& r) { r.set_width(0); }},
      {"height is 100000: must lie in [1, 4096]", [](auto& r) { r.set_height(100000); }},
      {"bytes, over this server's 1048576", [](auto& r) { r.set_width(4096), r.set_height(4096); },
       grpc::StatusCode::RESOURCE_EXHAUSTED},
      {"methods has 0 entries: must have 1 to 16", [](auto& r) { r.clear_methods(); }},
      {"methods has 17 entries",
       [](auto& r) {
         for (int i = 0; i < 16; ++i) r.add_methods()->set_name("sm");
       }},
      {"methods[0]: ", [](auto& r) { r.mutable_methods(0)->set_name("nothing"); },
       grpc::StatusCode::NOT_FOUND},
      {"methods[0]: ", [](auto& r) { (*r.mutable_methods(0)->mutable_parameters())["colour"] = "red"; }},
      {"methods[0]: ", [](auto& r) { (*r.mutable_methods(0)->mutable_parameters())["texels"] = "-1"; }},
      {"baseline: ", [](auto& r) { r.mutable_baseline()->set_name("nothing"); }, grpc::StatusCode::NOT_FOUND},
      {"repetitions is 101: must lie in [0, 100]", [](auto& r) { r.set_repetitions(101); }},
      {"max_repetitions is 101: must lie in [0, 100]", [](auto& r) { r.set_max_repetitions(101); }},
      {"quartile_target is -0.1", [](auto& r) { r.set_quartile_target(-0.1); }},
      {"quartile_target is nan", [&](auto& r) { r.set_quartile_target(nan); }},
      {"images[1] is 99", [](auto& r) { r.add_images(static_cast<v1::Aov>(99)); }},
      {"images[1] is 0", [](auto& r) { r.add_images(v1::AOV_UNSPECIFIED); }},
      {"images[1] is VISIBILITY, which comes before", [](auto& r) { r.add_images(v1::VISIBILITY); }},
      {"view.eye is nan,0,0", [&](auto& r) { view(r)->mutable_eye()->set_x(nan); }},
      {"view.target is 0,0,0, where eye is: must differ", [&](auto& r) { view(r)->clear_target(); }},
      {"view.up is 0,0,2: must not be parallel", [&](auto& r) { view(r)->mutable_up()->set_z(2); }},
      {"view.up is 0,0,0", [&](auto& r) { view(r)->mutable_up(); }},
      {"view.vertical_fov_degrees is 180: must lie in (0, 180)",
       [&](auto& r) { view(r)->set_vertical_fov_degrees(180); }},
      {"view.vertical_fov_degrees is nan", [&](auto& r) { view(r)->set_vertical_fov_degrees(nan); }},
      {"light.kind isn't set", [](auto& r) { r.mutable_light(); }},
      {"light.sun.direction is 0,0,0", [](auto& r) { r.mutable_light()->mutable_sun(); }},
      {"light.spot.target is 0,0,0, where eye is", [](auto& r) { r.mutable_light()->mutable_spot(); }},
      {"light.spot.cone_degrees is 171: must lie in (0, 170]",
       [](auto& r) {
         r.mutable_light()->mutable_spot()->mutable_target()->set_y(-1);
         r.mutable_light()->mutable_spot()->set_cone_degrees(171);
       }},
      {"light.point.position is inf,0,0",
       [](auto& r) {
         r.mutable_light()->mutable_point()->mutable_position()->set_x(
             std::numeric_limits<double>::infinity());
       }},
  };
  for (const Case& one : cases) {
    v1::RenderRequest request = renderRequest();
    one.spoil(request);
    const grpc::Status status = render(request);
    EXPECT_EQ(status.error_code(), one.code) << one.expected << " / " << status.error_message();
    EXPECT_NE(status.error_message().find(one.expected), std::string::npos)
        << one.expected << " / " << status.error_message();
    EXPECT_EQ(status.error_message().find('\n'), std::string::npos);
  }
  EXPECT_EQ(renderer->jobsBegun, 0u);
  EXPECT_TRUE(render(renderRequest()).ok());  // the server goes on serving
}

// --- Cancelling, deadlines, limits

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

// --- Scenes

class UploadTest : public ServiceTest {
 protected:
  struct Upload {
    explicit Upload(v1::Sundial::Stub& stub) : writer(stub.UploadScene(&context, &info)) {}
    Upload& main(const std::string& name) {
      return write([&](auto& part) { part.set_main(name); });
    }
    Upload& file(const std::string& name) {
      return write([&](auto& part) { part.set_file(name); });
    }
    Upload& chunk(const std::string& bytes) {
      return write([&](auto& part) { part.set_chunk(bytes); });
    }
    template <class Set>
    Upload& write(Set set) {
      v1::UploadSceneRequest part;
      set(part);
      writer->Write(part);  // fails once the server has given up; finish() says why
      return *this;
    }
    grpc::Status finish() {
      writer->WritesDone();
      return writer->Finish();
    }
    grpc::ClientContext context;
    v1::SceneInfo info;
    std::unique_ptr<grpc::ClientWriter<v1::UploadSceneRequest>> writer;
  };
};

TEST_F(UploadTest, SceneCanBeRenderedAndIsHeldOnce) {
  start();
  Upload first(*stub);
  ASSERT_TRUE(
      first.main("a.glb").file("a.glb").chunk("scene ").chunk("one").file("b.bin").chunk("x").finish().ok());
  EXPECT_TRUE(first.info.loaded());
  EXPECT_EQ(first.info.reference(), "digest:" + first.info.digest());
  EXPECT_EQ(first.info.views_size(), 2);
  Upload second(*stub);
  ASSERT_TRUE(second.main("c.glb").file("b.bin").chunk("x").file("c.glb").chunk("scene one").finish().ok());
  EXPECT_EQ(second.info.digest(), first.info.digest());
  EXPECT_EQ(scenes.parsed, 1u);
  EXPECT_EQ(server->store().count(), 1u);

  v1::RenderRequest request = renderRequest();
  request.set_scene(first.info.reference());
  Stream stream(*stub, request);
  EXPECT_TRUE(stream.finish().ok());
  EXPECT_EQ(stream.events[0].accepted().scene_digest(), first.info.digest());
}

TEST_F(UploadTest, BadOnesAreRefusedAndNotKept) {
  options.calls.uploadBytes = 300'000;
  start();
  struct Case {
    const char* expected;
    std::function<void(Upload&)> send;
    grpc::StatusCode code = grpc::StatusCode::INVALID_ARGUMENT;
  };
  const Case cases[] = {
      {"part isn't set", [](Upload& u) { u.write([](auto&) {}); }},
      {"file comes before main", [](Upload& u) { u.file("a.glb"); }},
      {"chunk comes before file", [](Upload& u) { u.main("a.glb").chunk("x"); }},
      {"main is given twice", [](Upload& u) { u.main("a.glb").main("a.glb"); }},
      {"main has 0 bytes", [](Upload& u) { u.main(""); }},
      {"file 'a.glb' is given twice", [](Upload& u) { u.main("a.glb").file("a.glb").file("a.glb"); }},
      {"chunk has 262145 bytes: must have at most 262144",
       [](Upload& u) { u.main("a.glb").file("a.glb").chunk(std::string(262'145, 'x')); }},
      {"main is '', which is not among the 0 files", [](Upload&) {}},
      {"main is 'a.glb', which is not among the 1 files", [](Upload& u) { u.main("a.glb").file("b.glb"); }},
      {"no scene: cut off", [](Upload& u) { u.main("a.glb").file("a.glb").chunk("x"); },
       grpc::StatusCode::DATA_LOSS},
      {"larger than this server's 300000 bytes",
       [](Upload& u) {
         u.main("a.glb")
             .file("a.glb")
             .chunk("scene")
             .chunk(std::string(200'000, 'x'))
             .chunk(std::string(200'000, 'x'));
       },
       grpc::StatusCode::RESOURCE_EXHAUSTED},
  };
  for (const Case& one : cases) {
    Upload upload(*stub);
    one.send(upload);
    const grpc::Status status = upload.finish();
    EXPECT_EQ(status.error_code(), one.code) << one.expected << " / " << status.error_message();
    EXPECT_NE(status.error_message().find(one.expected), std::string::npos)
        << one.expected << " / " << status.error_message();
  }
  EXPECT_EQ(server->store().count(), 0u);
}

TEST_F(UploadTest, UploadsInFlightShareALimit) {
  options.calls.uploadBytes = 300'000;
  start();
  Upload first(*stub), second(*stub);
  const std::string chunk = "scene" + std::string(199'995, 'x');
  first.main("a.glb").file("a.glb").chunk(chunk);
  second.main("b.glb").file("b.glb").chunk(chunk);
  // The one that came first holds its bytes at the gate until the other has been refused.
  scenes.gate.close();
  auto firstEnded = std::async(std::launch::async, [&] { return first.finish(); });
  auto secondEnded = std::async(std::launch::async, [&] { return second.finish(); });
  records.await("UploadScene", 1, grpc::StatusCode::RESOURCE_EXHAUSTED);
  scenes.gate.open();
  const grpc::Status one = firstEnded.get(), two = secondEnded.get();
  EXPECT_NE(one.ok(), two.ok());
  const Upload& refused = one.ok() ? second : first;
  EXPECT_EQ((one.ok() ? two : one).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(refused.context.GetServerTrailingMetadata().count("sundial-retry-ms"), 1u);
}

TEST_F(UploadTest, StalledUploadEndsAndIsNotKept) {
  options.calls.stallTimeout = milliseconds(50);
  start();
  Upload upload(*stub);
  upload.main("a.glb").file("a.glb").chunk("scene one");
  const CallRecord record = records.await("UploadScene", 1);
  EXPECT_EQ(record.status, grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_EQ(upload.finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  server->stop(milliseconds(0));
  EXPECT_EQ(server->store().count(), 0u);
  EXPECT_EQ(scenes.parsed, 0u);
}

TEST_F(UploadTest, AbortedUploadIsNotKept) {
  start();
  for (std::size_t i = 1; i <= 20; ++i) {
    Upload upload(*stub);
    upload.main("a.glb").file("a.glb").chunk("scene one");
    upload.context.TryCancel();
    EXPECT_EQ(upload.finish().error_code(), grpc::StatusCode::CANCELLED);
    EXPECT_EQ(records.await("UploadScene", i).status, grpc::StatusCode::CANCELLED);
  }
  server->stop(milliseconds(0));
  EXPECT_EQ(server->store().count(), 0u);
}

TEST_F(ServiceTest, ScenesAreListedLoadedAndUnloaded) {
  start();
  const auto list = [&] {
    grpc::ClientContext context;
    v1::ListScenesResponse answer;
    EXPECT_TRUE(stub->ListScenes(&context, {}, &answer).ok());
    return answer;
  };
  EXPECT_EQ(list().scenes_size(), 1);
  EXPECT_EQ(list().scenes(0).reference(), "builtin:small");
  EXPECT_EQ(list().scenes(0).description(), "a small one");
  EXPECT_FALSE(list().scenes(0).loaded());

  v1::LoadSceneRequest load;
  load.set_scene("builtin:small");
  v1::SceneInfo info;
  {
    grpc::ClientContext context;
    ASSERT_TRUE(stub->LoadScene(&context, load, &info).ok());
  }
  EXPECT_TRUE(info.loaded());
  EXPECT_EQ(info.bytes(), 64u);
  EXPECT_EQ(info.lights(1), "lamp");
  EXPECT_TRUE(list().scenes(0).loaded());
  EXPECT_EQ(list().scenes(0).digest(), info.digest());

  v1::UnloadSceneRequest unload;
  unload.set_scene("builtin:small");
  v1::UnloadSceneResponse nothing;
  {
    grpc::ClientContext context;
    EXPECT_TRUE(stub->UnloadScene(&context, unload, &nothing).ok());
  }
  EXPECT_FALSE(list().scenes(0).loaded());
  {
    grpc::ClientContext context;
    EXPECT_EQ(stub->UnloadScene(&context, unload, &nothing).error_code(), grpc::StatusCode::NOT_FOUND);
  }
  {
    grpc::ClientContext context;
    load.set_scene("builtin:none");
    EXPECT_EQ(stub->LoadScene(&context, load, &info).error_code(), grpc::StatusCode::NOT_FOUND);
  }
}

TEST_F(ServiceTest, UnloadedSceneStaysWithThoseThatRenderIt) {
  start();
  renderer->gate.close();
  Stream stream(*stub, renderRequest());
  renderer->gate.awaitArrivals(1);
  grpc::ClientContext context;
  v1::UnloadSceneRequest unload;
  unload.set_scene("builtin:small");
  v1::UnloadSceneResponse nothing;
  EXPECT_TRUE(stub->UnloadScene(&context, unload, &nothing).ok());
  EXPECT_EQ(server->store().count(), 0u);
  renderer->gate.open();
  EXPECT_TRUE(stream.finish().ok());
}

TEST_F(ServiceTest, LoadingKeepsNobodyElseWaiting) {
  start();
  ASSERT_TRUE(render(renderRequest()).ok());
  scenes.gate.close();
  v1::RenderRequest other = renderRequest();
  other.set_scene("builtin:small?bytes=100");
  Stream loading(*stub, other);
  scenes.gate.awaitArrivals(2);
  EXPECT_TRUE(render(renderRequest()).ok());  // of the scene that is loaded
  loading.context.TryCancel();
  EXPECT_EQ(loading.finish().error_code(), grpc::StatusCode::CANCELLED);
  records.await("Render", 1, grpc::StatusCode::CANCELLED);
  scenes.gate.open();
}

// --- The server

TEST_F(ServiceTest, TellsItsMethodsAndItself) {
  start();
  v1::ListMethodsResponse methods;
  {
    grpc::ClientContext context;
    ASSERT_TRUE(stub->ListMethods(&context, {}, &methods).ok());
  }
  ASSERT_EQ(static_cast<std::size_t>(methods.methods_size()), methodTable().size());
  for (const v1::Method& method : methods.methods()) {
    EXPECT_FALSE(method.name().empty() || method.title().empty() || method.source().empty()) << method.name();
    for (const v1::Parameter& parameter : method.parameters()) EXPECT_FALSE(parameter.kind().empty());
  }
  EXPECT_EQ(methods.methods(0).stages().size(), 7u);

  renderer->gate.close();
  Stream running(*stub, renderRequest());
  renderer->gate.awaitArrivals(1);
  Stream waiting(*stub, renderRequest());
  ASSERT_TRUE(waiting.read());
  v1::ServerInfo info;
  {
    grpc::ClientContext context;
    ASSERT_TRUE(stub->GetServerInfo(&context, {}, &info).ok());
  }
  EXPECT_EQ(info.device(), "fake");
  EXPECT_EQ(info.driver(), "fake driver");
  EXPECT_FALSE(info.version().empty());
  EXPECT_EQ(info.max_image_side(), 8192u);
  EXPECT_EQ(info.max_queued(), 64u);
  EXPECT_EQ(info.max_queued_per_client(), 8u);
  EXPECT_EQ(info.queued(), 1u);
  EXPECT_EQ(info.rendering(), 1u);
  renderer->gate.open();
}

grpc::ByteBuffer bufferOf(const std::string& bytes) {
  const grpc::Slice slice(bytes);
  return {&slice, 1};
}
std::string bytesOf(const grpc::ByteBuffer& buffer) {
  grpc::Slice slice;
  EXPECT_TRUE(buffer.TrySingleSlice(&slice).ok() || buffer.DumpToSingleSlice(&slice).ok());
  return {reinterpret_cast<const char*>(slice.begin()), slice.size()};
}

// The answer of grpc.health.v1.Health/Check, for a service: "\x08\x01" is SERVING, "\x08\x02" NOT_SERVING.
std::string health(const std::shared_ptr<grpc::Channel>& channel, const std::string& service) {
  grpc::GenericStub stub(channel);
  grpc::ClientContext context;
  std::string request;
  if (!service.empty()) request = std::string("\x0a") + static_cast<char>(service.size()) + service;
  const grpc::ByteBuffer in = bufferOf(request);
  grpc::ByteBuffer out;
  std::promise<grpc::Status> ended;
  stub.UnaryCall(&context, "/grpc.health.v1.Health/Check", {}, &in, &out,
                 [&](grpc::Status status) { ended.set_value(std::move(status)); });
  const grpc::Status status = ended.get_future().get();
  return status.ok() ? bytesOf(out) : status.error_message();
}

TEST_F(ServiceTest, HealthIsTold) {
  start();
  EXPECT_EQ(health(channel(), ""), "\x08\x01");
  EXPECT_EQ(health(channel(), "sundial.v1.Sundial"), "\x08\x01");
}

// What tools without the contract ask: the list of services.
TEST_F(ServiceTest, ReflectionListsTheService) {
  start();
  struct Ask final : grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
    explicit Ask(grpc::GenericStub& stub) {
      stub.PrepareBidiStreamingCall(
          &context, "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", {}, this);
      StartWriteLast(&request, {});
      StartRead(&answer);
      StartCall();
    }
    void OnDone(const grpc::Status& status) override { ended.set_value(status); }
    grpc::ClientContext context;
    grpc::ByteBuffer request = bufferOf("\x3a\x01*"), answer;  // list_services: "*"
    std::promise<grpc::Status> ended;
  };
  grpc::GenericStub generic(channel());
  Ask ask(generic);
  EXPECT_TRUE(ask.ended.get_future().get().ok());
  EXPECT_NE(bytesOf(ask.answer).find("sundial.v1.Sundial"), std::string::npos);
}

TEST_F(ServiceTest, StoppingFinishesWhatWasAccepted) {
  start();
  renderer->gate.close();
  Stream running(*stub, renderRequest(300, 300));
  renderer->gate.awaitArrivals(1);
  Stream waiting(*stub, renderRequest());
  ASSERT_TRUE(waiting.read());
  const auto probe = channel();
  const auto other = client();
  auto stopped = std::async(std::launch::async, [&] { server->stop(std::chrono::hours(1)); });

  // Health says it before renderings are refused; one that comes in between is accepted, and so finished.
  while (health(probe, "") == "\x08\x01") {
  }
  EXPECT_EQ(health(probe, "sundial.v1.Sundial"), "\x08\x02");
  std::deque<Stream> between;
  for (;;) {
    Stream& late = between.emplace_back(*other, renderRequest());
    if (late.read()) continue;
    const grpc::Status refused = late.reader->Finish();
    EXPECT_EQ(refused.error_code(), grpc::StatusCode::UNAVAILABLE);
    EXPECT_NE(refused.error_message().find("stopping"), std::string::npos) << refused.error_message();
    between.pop_back();
    break;
  }
  EXPECT_EQ(renderer->jobsDone, 0u);
  renderer->gate.open();
  EXPECT_TRUE(running.finish().ok());
  EXPECT_TRUE(waiting.finish().ok());
  for (Stream& late : between) EXPECT_TRUE(late.finish().ok());
  EXPECT_EQ(running.order(), "accepted layout image_begin image_chunk image_chunk image_end timings done");
  stopped.get();
}

TEST_F(ServiceTest, StoppingWithoutPatienceEndsEverything) {
  start();
  renderer->gate.close();
  Stream running(*stub, renderRequest());
  renderer->gate.awaitArrivals(1);
  Stream waiting(*stub, renderRequest());
  ASSERT_TRUE(waiting.read());
  auto stopped = std::async(std::launch::async, [&] { server->stop(milliseconds(0)); });
  EXPECT_EQ(waiting.finish().error_code(), grpc::StatusCode::UNAVAILABLE);
  renderer->gate.open();
  EXPECT_FALSE(running.finish().ok() && renderer->passesRun < FakeState::kPasses);
  stopped.get();
}

TEST_F(ServiceTest, PortInUseIsSaid) {
  start();
  ServerOptions second;
  second.listen = server->addresses();
  const auto failed = Server::start(second, std::make_unique<FakeRenderer>(renderer), scenes.source());
  ASSERT_FALSE(failed);
  const std::string port = second.listen[0].substr(second.listen[0].rfind(':') + 1);
  EXPECT_EQ(failed.error().message, "port " + port +
                                        " of 127.0.0.1 is in use: stop the server that has it, or give "
                                        "another port (0: any that is free)");
  EXPECT_TRUE(render(renderRequest()).ok());  // the first one goes on serving
}

TEST_F(ServiceTest, PathInUseIsSaid) {
  const std::string path = fmt::format("{}/sundial-{}.sock", ::testing::TempDir(), ::getpid());
  options.listen = {"unix:" + path};
  start();
  EXPECT_TRUE(render(renderRequest()).ok());
  const auto failed = Server::start(options, std::make_unique<FakeRenderer>(renderer), scenes.source());
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.error().message.find("is in use by another server"), std::string::npos)
      << failed.error().message;
  EXPECT_TRUE(render(renderRequest()).ok());
}

TEST_F(ServiceTest, AddressThatCannotBeHadIsSaid) {
  for (const auto& [address, expected] :
       {std::pair{"nonsense", "give HOST:PORT or unix:PATH"},
        {"192.0.2.1:0", "can't listen on 192.0.2.1:0"},
        {"unix:/nowhere/at/all.sock", "can't make unix:/nowhere/at/all.sock"},
        {"127.0.0.1:99999", "port 99999 must lie in [0, 65535]"}}) {
    options.listen = {address};
    const auto failed = Server::start(options, std::make_unique<FakeRenderer>(renderer), scenes.source());
    ASSERT_FALSE(failed) << address;
    EXPECT_NE(failed.error().message.find(expected), std::string::npos) << failed.error().message;
  }
}

TEST_F(ServiceTest, RendererThatThrowsIsAnError) {
  struct Broken final : Renderer {
    const DeviceInfo& device() const override { return info; }
    std::uint64_t validationMessages() const override { return 0; }
    Result<void> run(const RenderJob& job, const Interrupt&, JobSink&) override {
      if (job.size.x == 1) throw std::bad_alloc();
      throw std::runtime_error("device lost");
    }
    Result<void> runStability(const StabilityJob&, const Interrupt&, StabilitySink&) override {
      throw std::runtime_error("device lost");
    }
    DeviceInfo info;
  };
  std::atomic<unsigned> broken = 0;
  options.onBroken = [&](const std::string&) { ++broken; };
  auto started = Server::start(options, std::make_unique<Broken>(), scenes.source());
  ASSERT_TRUE(started);
  server = std::move(*started);
  stub = client();
  EXPECT_EQ(render(renderRequest(1, 1)).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  const grpc::Status lost = render(renderRequest());
  EXPECT_EQ(lost.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_NE(lost.error_message().find("device lost"), std::string::npos);
  EXPECT_EQ(broken, 0u);
  render(renderRequest());
  render(renderRequest());  // the third in a row
  EXPECT_EQ(broken, 1u);
}

}  // namespace
}  // namespace sundial
