// The service's Stability and ListStabilityCases over real gRPC, with a fake renderer.
#include <gtest/gtest.h>

#include <span>

#include "service/server.h"
#include "sundial/crc32c.h"
#include "support/test_server.h"

namespace sundial {
namespace {

using namespace test;
using std::chrono::milliseconds;

// The camera steps aside in three frames.
v1::StabilityRequest stabilityRequest() {
  v1::StabilityRequest request;
  request.set_scene("builtin:small");
  v1::CameraPath& path = *request.mutable_path();
  for (const double x : {0.0, 1.0}) {
    v1::View& key = *path.add_keys();
    key.mutable_eye()->set_x(x);
    key.mutable_eye()->set_z(5);
    key.mutable_target()->set_x(x);
    key.set_vertical_fov_degrees(50);
  }
  path.set_frames(3);
  request.mutable_light()->mutable_sun()->mutable_direction()->set_y(-1);
  request.set_width(4);
  request.set_height(2);
  request.add_methods()->set_name("sm");
  return request;
}

struct StabilityAnswer {
  grpc::Status status;
  std::vector<v1::StabilityEvent> events;
};

StabilityAnswer ask(v1::Sundial::Stub& stub, const v1::StabilityRequest& request) {
  grpc::ClientContext context;
  StabilityAnswer answer;
  const auto reader = stub.Stability(&context, request);
  for (v1::StabilityEvent event; reader->Read(&event);) answer.events.push_back(event);
  answer.status = reader->Finish();
  return answer;
}

class StabilityServiceTest : public ServiceTest {
 protected:
  template <class Change>
  void expectRefused(Change change, grpc::StatusCode code, const std::string& words) {
    v1::StabilityRequest request = stabilityRequest();
    change(request);
    const StabilityAnswer answer = ask(*stub, request);
    EXPECT_EQ(answer.status.error_code(), code) << words;
    EXPECT_NE(answer.status.error_message().find(words), std::string::npos) << answer.status.error_message();
    EXPECT_TRUE(answer.events.empty());
  }
};

TEST_F(StabilityServiceTest, EventsComeInOrder) {
  start();
  v1::StabilityRequest request = stabilityRequest();
  request.add_methods()->set_name("dv");
  request.set_pictures(1);
  const StabilityAnswer answer = ask(*stub, request);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  std::string order;
  for (const v1::StabilityEvent& event : answer.events) order += static_cast<char>('0' + event.event_case());
  // Accepted; for each method three frames, a picture's begin, chunk and end, the outcome; done.
  ASSERT_EQ(order, "1222345622234567");
  EXPECT_EQ(answer.events[0].accepted().bytes_expected(), 2u * 4 * 2 * 4);
  EXPECT_EQ(answer.events[0].accepted().view().eye().z(), 5);  // of the first frame
  EXPECT_EQ(answer.events[0].accepted().light().sun().direction().y(), -1);
  EXPECT_EQ(answer.events[2].frame().frame(), 1u);
  EXPECT_EQ(answer.events[2].frame().frames(), 3u);
  EXPECT_EQ(answer.events[4].picture_begin().flipped(0).y(), 2);
  const std::string& bytes = answer.events[5].image_chunk().data();
  EXPECT_EQ(answer.events[6].image_end().crc32c(), crc32c(std::as_bytes(std::span(bytes))));
  EXPECT_EQ(answer.events[14].outcome().method(), 1u);
  const v1::StabilityResult& result = answer.events[14].outcome().result();
  EXPECT_EQ(result.method(), "dv");
  EXPECT_EQ(result.flip_rate(), 0.25);
  EXPECT_EQ(result.pop(), 0.5);
  EXPECT_EQ(result.pairs(), 20);
  EXPECT_EQ(std::vector<double>(result.flips_per_frame().begin(), result.flips_per_frame().end()),
            (std::vector<double>{0, 0, 5}));
  EXPECT_EQ(records.await("Stability", 1).bytesSent, 64u);
}

TEST_F(StabilityServiceTest, WhatCanNeverWorkIsRefused) {
  start();
  const auto refuses = [&](auto change, const std::string& words) {
    expectRefused(change, grpc::StatusCode::INVALID_ARGUMENT, words);
  };
  using Request = v1::StabilityRequest;
  refuses([](Request& r) { r.mutable_path()->clear_keys(); }, "path.keys has 0 entries: must have 1 to 1000");
  refuses([](Request& r) { r.mutable_path()->set_frames(0); }, "path.frames is 0: must lie in [1, 2000]");
  refuses([](Request& r) { *r.mutable_path()->mutable_keys(1)->mutable_target() = r.path().keys(1).eye(); },
          "path.keys[1].target");
  refuses([](Request& r) { r.set_frames(2001); }, "frames is 2001: must lie in [0, 2000]");
  refuses([](Request& r) { r.set_points(65537); }, "points is 65537");
  refuses([](Request& r) { r.set_pictures(65); }, "pictures is 65");
  refuses([](Request& r) { r.set_width(0); }, "width is 0");
  refuses([](Request& r) { r.clear_methods(); }, "methods has 0 entries");
  refuses([](Request& r) { r.mutable_light_path()->set_frames(2); }, "light_path.keys has 0 entries");
  // The target moves through the eye.
  refuses(
      [](Request& r) {
        *r.mutable_path()->mutable_keys(1) = r.path().keys(0);
        r.mutable_path()->mutable_keys(1)->mutable_target()->set_z(10);
      },
      "between its keys 0 and 1");
}

TEST_F(StabilityServiceTest, NamesThatTheSceneHasNotAreRefused) {
  start();
  expectRefused([](v1::StabilityRequest& r) { r.set_path_name("nowhere"); }, grpc::StatusCode::NOT_FOUND,
                "no path 'nowhere'");
  expectRefused([](v1::StabilityRequest& r) { r.set_light_path_name("never"); }, grpc::StatusCode::NOT_FOUND,
                "no light path 'never'");
  expectRefused([](v1::StabilityRequest& r) { r.mutable_methods(0)->set_name("nonesuch"); },
                grpc::StatusCode::NOT_FOUND, "nonesuch");
}

TEST_F(StabilityServiceTest, StopsBetweenFramesAtItsDeadline) {
  start();
  renderer->gate.close();
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + milliseconds(200));
  const auto reader = stub->Stability(&context, stabilityRequest());
  v1::StabilityEvent event;
  while (reader->Read(&event)) continue;
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  records.await("Stability", 1);
  renderer->gate.open();
  EXPECT_TRUE(ask(*stub, stabilityRequest()).status.ok());
  EXPECT_EQ(renderer->jobsDone, 1u);
}

TEST_F(StabilityServiceTest, CasesAreListedWhole) {
  start();
  grpc::ClientContext context;
  v1::ListStabilityCasesResponse answer;
  ASSERT_TRUE(stub->ListStabilityCases(&context, {}, &answer).ok());
  ASSERT_GE(answer.cases_size(), 9);
  for (const v1::StabilityCase& row : answer.cases()) {
    EXPECT_FALSE(row.name().empty() || row.sentence().empty()) << row.name();
    EXPECT_EQ(row.tells_apart(), row.fails_above() > 0);
    EXPECT_GE(row.request().methods_size(), row.tells_apart() ? 2 : 1);
    EXPECT_TRUE(!row.has_twin() || row.twin().scene() != row.request().scene());
  }
  EXPECT_EQ(answer.cases(0).request().methods(0).parameters().at("texels"), "512");
}

}  // namespace
}  // namespace sundial
