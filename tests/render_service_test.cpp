// The render rpc: what is streamed, what is refused, what is the same every time.
#include <gtest/gtest.h>

#include <future>
#include <span>

#include "service/server.h"
#include "sundial/crc32c.h"
#include "support/test_server.h"

namespace sundial {
namespace {

using namespace test;

std::uint32_t checksum(const std::string& bytes) { return crc32c(std::as_bytes(std::span(bytes))); }

std::string bytesOf(const Image& image) {
  return {reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size()};
}

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

}  // namespace
}  // namespace sundial
