// The client library believes only what is whole, asks again where it may, and sends a scene's files.
#include "sundial/client.h"

#include <gtest/gtest.h>

#include <fstream>

#include "fake_server.h"
#include "sundial/connect.h"
#include "sundial/method_choice.h"

namespace sundial::client {
namespace {

namespace fs = std::filesystem;

class ClientTest : public testing::Test {
 protected:
  test::FakeServer server;
  Client client{connect(server.address()).value()};

  static v1::RenderRequest request() {
    v1::RenderRequest request;
    request.set_scene("builtin:discs");
    request.set_width(300);  // rows that no chunk boundary meets
    request.set_height(257);
    request.add_methods()->set_name("sm");
    request.add_methods()->set_name("ray-traced");
    for (const v1::Aov aov : {v1::COLOUR, v1::POSITION}) request.add_images(aov);
    return request;
  }

  // The message of the DATA_LOSS that a changed stream must end in.
  std::string damage(std::function<bool(v1::RenderEvent&)> tamper) {
    server.tamper = std::move(tamper);
    const auto rendering = client.render(request());
    if (rendering) return "it was believed";
    EXPECT_EQ(rendering.error().code, grpc::DATA_LOSS);
    return rendering.error().message;
  }
};

TEST_F(ClientTest, ReturnsAWholeRendering) {
  std::vector<Progress> seen;
  const auto rendering =
      client.render(request(), [&](const Progress& progress) { seen.push_back(progress); });
  ASSERT_TRUE(rendering) << rendering.error().message;
  ASSERT_EQ(rendering->methods.size(), 2u);
  for (const MethodRendering& method : rendering->methods) {
    ASSERT_EQ(method.images.size(), 2u);
    EXPECT_EQ(method.find(v1::COLOUR)->bytes.size(), 300u * 257 * 4);
    EXPECT_EQ(method.find(v1::POSITION)->bytes.size(), 300u * 257 * 12);
    EXPECT_EQ(method.find(v1::ID), nullptr);
    EXPECT_GT(method.result.frame_ms(), 0);
  }
  EXPECT_EQ(rendering->methods[0].plan.views_size(), 1);
  EXPECT_EQ(rendering->methods[1].plan.views_size(), 0);
  EXPECT_EQ(seen.back().bytes, seen.back().bytesExpected);
  EXPECT_EQ(seen.back().methodsDone, 2u);
}

TEST_F(ClientTest, ImagesComeInTheOrderAsked) {
  v1::RenderRequest reversed = request();
  reversed.mutable_images()->SwapElements(0, 1);
  EXPECT_EQ(client.render(reversed)->methods[0].images[0].aov, v1::POSITION);
}

TEST_F(ClientTest, RefusesAStreamWithoutItsEnd) {
  EXPECT_NE(
      damage([](const v1::RenderEvent& event) { return !event.has_done(); }).find("stops before its end"),
      std::string::npos);
}

TEST_F(ClientTest, RefusesAWrongChecksum) {
  EXPECT_NE(damage([](v1::RenderEvent& event) {
              if (event.has_image_end())
                event.mutable_image_end()->set_crc32c(event.image_end().crc32c() ^ 1);
              return true;
            }).find("colour image's checksum"),
            std::string::npos);
}

TEST_F(ClientTest, RefusesAFlippedBit) {
  EXPECT_NE(damage([](v1::RenderEvent& event) {
              if (event.has_image_chunk()) (*event.mutable_image_chunk()->mutable_data())[7] ^= 4;
              return true;
            }).find("checksum"),
            std::string::npos);
}

TEST_F(ClientTest, RefusesTooFewAndTooManyBytes) {
  EXPECT_NE(damage([](v1::RenderEvent& event) {
              if (event.has_image_chunk()) event.mutable_image_chunk()->mutable_data()->pop_back();
              return true;
            }).find(" of 308400 bytes"),
            std::string::npos);
  EXPECT_NE(damage([](v1::RenderEvent& event) {
              if (event.has_image_chunk()) event.mutable_image_chunk()->mutable_data()->append("xxxx");
              return true;
            }).find("too many bytes"),
            std::string::npos);
}

TEST_F(ClientTest, RefusesAnImageOfAnotherSize) {
  EXPECT_NE(damage([](v1::RenderEvent& event) {
              if (event.has_image_begin()) event.mutable_image_begin()->set_bytes(1ull << 60);
              return true;
            }).find("not 300x257"),
            std::string::npos);
}

TEST_F(ClientTest, RefusesMissingTimes) {
  EXPECT_NE(damage([](v1::RenderEvent& event) {
              if (event.has_timings()) event.clear_event();
              return true;
            }).find("times are missing"),
            std::string::npos);
}

TEST_F(ClientTest, IgnoresEventsOfANewerServer) {
  server.tamper = [](v1::RenderEvent& event) {
    if (event.has_layout()) event.clear_event();
    return true;
  };
  EXPECT_TRUE(client.render(request()));
}

TEST_F(ClientTest, WaitsForAFullQueue) {
  server.queueFull = 5;
  EXPECT_TRUE(client.render(request()));
  EXPECT_EQ(server.renderings, 6);
}

TEST_F(ClientTest, GivesUpOnALostServer) {
  server.lost = 1;
  EXPECT_TRUE(client.render(request()));
  server.lost = 100;
  server.renderings = 0;
  EXPECT_EQ(client.render(request()).error().code, grpc::UNAVAILABLE);
  EXPECT_EQ(server.renderings, 4);
}

TEST_F(ClientTest, DoesNotRetryAGoodRefusal) {
  server.refusal = {grpc::RESOURCE_EXHAUSTED, "the picture is too large"};
  EXPECT_EQ(client.render(request()).error().message, "the picture is too large");
  EXPECT_EQ(server.renderings, 1);
}

TEST_F(ClientTest, StopsWhenAsked) {
  std::stop_source stop;
  server.hang = [&] { stop.request_stop(); };
  const Client stoppable(connect(server.address()).value(), {.stop = stop.get_token()});
  EXPECT_EQ(stoppable.render(request()).error().code, grpc::CANCELLED);
}

TEST_F(ClientTest, UploadsAGltfWithItsSiblings) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder.path() / "parts");
  const std::string big(700'000, 'b');
  std::ofstream(folder.path() / "parts" / "a b.bin") << big;
  std::ofstream(folder.path() / "leaf.png") << "png";
  const std::string json =
      R"({"buffers": [{"uri": "parts/a%20b.bin"}, {"uri": "data:application/x;base64,AA"}],
    "images": [{"uri": "leaf.png"}, {"uri": "leaf.png"}, {"bufferView": 0}]})";
  std::ofstream(folder.path() / "s.gltf") << json;

  const auto files = gatherSceneFiles(folder.path() / "s.gltf");
  ASSERT_TRUE(files) << files.error().message;
  const auto info = client.upload(*files);
  ASSERT_TRUE(info) << info.error().message;
  EXPECT_EQ(info->reference(), "digest:" + digestOf(*files).value_or("unreadable"));
  EXPECT_EQ(server.uploadedMain, "s.gltf");
  EXPECT_EQ(server.uploaded, (std::map<std::string, std::string>{
                                 {"s.gltf", json}, {"parts/a%20b.bin", big}, {"leaf.png", "png"}}));
  EXPECT_EQ(server.largestChunk, 256u * 1024);
}

TEST_F(ClientTest, UploadsWhatAGlbRefersTo) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "x.bin") << "x";
  const std::string json = R"({"buffers":[{"uri":"x.bin"}]})";
  std::string glb = "glTF";
  for (const auto value : {2u, static_cast<unsigned>(20 + json.size()), static_cast<unsigned>(json.size())})
    for (int shift = 0; shift < 32; shift += 8) glb += static_cast<char>(value >> shift);
  std::ofstream(folder.path() / "s.glb", std::ios::binary) << glb << "JSON" << json;
  EXPECT_EQ(gatherSceneFiles(folder.path() / "s.glb")->files.size(), 2u);

  // Cut off at any byte it is sent alone, for the server to judge.
  for (std::size_t length = 0; length < glb.size() + 4 + json.size(); ++length) {
    std::ofstream(folder.path() / "cut.glb", std::ios::binary) << (glb + "JSON" + json).substr(0, length);
    const auto files = gatherSceneFiles(folder.path() / "cut.glb");
    ASSERT_TRUE(files) << length;
    EXPECT_EQ(files->files.size(), 1u) << length;
  }
}

TEST(SceneFiles, StayInTheirFolder) {
  const test::TemporaryFolder folder;
  for (const char* uri :
       {"../x.bin", "a/../../x.bin", "/etc/passwd", "%2e%2e/x.bin", "http://a/b", "a\\\\b"}) {
    std::ofstream(folder.path() / "s.gltf") << R"({"buffers": [{"uri": ")" << uri << R"("}]})";
    const auto files = gatherSceneFiles(folder.path() / "s.gltf");
    ASSERT_FALSE(files) << uri;
    EXPECT_EQ(files.error().code, grpc::INVALID_ARGUMENT) << uri;
  }
  std::ofstream(folder.path() / "s.gltf") << R"({"buffers": [{"uri": "gone.bin"}]})";
  EXPECT_EQ(gatherSceneFiles(folder.path() / "s.gltf").error().code, grpc::NOT_FOUND);
  EXPECT_EQ(gatherSceneFiles(folder.path()).error().code, grpc::NOT_FOUND);
}

TEST(Connect, RefusesWhatIsNoAddress) {
  for (const char* address :
       {"", "host", "host:", "host:0", "host:65536", ":1", "a:1,", "unix:", "a:1,unix:/x"})
    EXPECT_EQ(connect(address).error().code, grpc::INVALID_ARGUMENT) << address;
}

TEST(Connect, SpreadsCallsOverSeveralServers) {
  test::FakeServer a("127.0.0.1:0"), b("127.0.0.1:0");
  const Client client(
      connect("localhost:" + std::to_string(a.port()) + ",127.0.0.1:" + std::to_string(b.port())).value());
  v1::RenderRequest request;
  request.set_width(4);
  request.set_height(4);
  request.add_methods()->set_name("sm");
  // Both are asked before long; each of these waits for nothing but an answer.
  for (int i = 0; i < 1000 && (a.renderings == 0 || b.renderings == 0); ++i)
    ASSERT_TRUE(client.render(request));
  EXPECT_GT(a.renderings, 0);
  EXPECT_GT(b.renderings, 0);
}

TEST(MethodChoice, ReadsAndWrites) {
  const auto choice = parseMethodChoice("sm,texels=1024x512,splits=4:12:40");
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->name(), "sm");
  EXPECT_EQ(choice->parameters().at("texels"), "1024x512");
  EXPECT_EQ(methodLabel(*choice), "sm,splits=4:12:40,texels=1024x512");
  for (const char* text : {"", ",a=1", "sm,", "sm,a", "sm,=1", "sm,a=", "sm,a=1,a=2", "a=1"})
    EXPECT_FALSE(parseMethodChoice(text)) << text;
}

}  // namespace
}  // namespace sundial::client
