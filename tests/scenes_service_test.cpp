// Uploading, loading, listing and unloading scenes.
#include <gtest/gtest.h>

#include <future>

#include "service/server.h"
#include "support/test_server.h"

namespace sundial {
namespace {

using namespace test;
using std::chrono::milliseconds;

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

}  // namespace
}  // namespace sundial
