// A server with a fake renderer and fake scenes on a port of its own, and a client's side of it.
#pragma once

#include <fmt/format.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <charconv>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "service/server.h"
#include "sundial/v1/sundial.grpc.pb.h"
#include "support/fake_renderer.h"

namespace sundial::test {

// A scene that takes about `bytes` of memory.
inline Scene sceneOf(std::string name, std::uint64_t bytes) {
  Scene scene;
  scene.name = std::move(name);
  scene.sourceTriangle.resize(bytes / sizeof(std::uint32_t));
  View far;
  far.eye = {0, 0, 100};
  scene.views = {{"near", View{}}, {"far", far}};
  scene.lights = {{"noon", Light{}}, {"lamp", Light{.kind = LightKind::point, .position = {1, 2, 3}}}};
  return scene;
}

// builtin:small?bytes=N; files whose content begins with "scene", of as many bytes as the content.
struct FakeScenes {
  std::atomic<unsigned> generated = 0, parsed = 0;
  Gate gate;  // before every parse and generation

  SceneSource source() {
    SceneSource source;
    source.read = [](const std::filesystem::path& path, const SceneLimits& limits) {
      return readSceneFiles(path, limits);
    };
    source.parse = [this](const SceneFiles& files, const SceneLimits&) -> Result<Scene> {
      gate.arrive();
      ++parsed;
      const std::string& main = files.files.at(files.main);
      if (!main.starts_with("scene")) return fail(ErrorCode::dataLoss, "no scene: cut off");
      return sceneOf(files.main, main.size());
    };
    source.generate = [this](std::string_view reference) -> Result<Scene> {
      gate.arrive();
      ++generated;
      if (!reference.starts_with("small"))
        return fail(ErrorCode::notFound, "no built-in scene: there is small");
      std::uint64_t bytes = 64;
      if (const auto at = reference.find("bytes="); at != std::string_view::npos) {
        std::from_chars(reference.data() + at + 6, reference.data() + reference.size(), bytes);
      }
      return sceneOf("small", bytes);
    };
    source.builtins = {{"small", "a small one"}};
    return source;
  }
};

// Calls that ended, as the server sees them.
class Records {
 public:
  void add(const CallRecord& record) {
    const std::lock_guard lock(mutex_);
    records_.push_back(record);
    changed_.notify_all();
  }
  // Blocks until so many calls of that rpc, with that status if one is given, have ended; gives the last of
  // them.
  CallRecord await(const std::string& rpc, std::size_t count, std::optional<grpc::StatusCode> status = {}) {
    std::unique_lock lock(mutex_);
    std::vector<CallRecord> matching;
    changed_.wait(lock, [&] {
      matching.clear();
      for (const CallRecord& record : records_) {
        if (record.rpc == rpc && record.status == status.value_or(record.status)) matching.push_back(record);
      }
      return matching.size() >= count;
    });
    return matching[count - 1];
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<CallRecord> records_;
};

inline v1::RenderRequest renderRequest(std::uint32_t width = 4, std::uint32_t height = 2) {
  v1::RenderRequest request;
  request.set_scene("builtin:small");
  request.set_width(width);
  request.set_height(height);
  request.add_methods()->set_name("sm");
  request.add_images(v1::VISIBILITY);
  return request;
}

// One rendering, from the client's side.
struct Stream {
  Stream(v1::Sundial::Stub& stub, const v1::RenderRequest& request,
         std::chrono::milliseconds deadline = std::chrono::hours(1)) {
    context.set_deadline(std::chrono::system_clock::now() + deadline);
    reader = stub.Render(&context, request);
  }
  bool read() {
    v1::RenderEvent event;
    if (!reader->Read(&event)) return false;
    events.push_back(std::move(event));
    return true;
  }
  grpc::Status finish() {
    while (read()) {
    }
    return reader->Finish();
  }
  std::string order() const {  // "accepted layout begin chunk end timings done"
    std::string names;
    for (const v1::RenderEvent& event : events) {
      const auto* field = event.GetDescriptor()->FindFieldByNumber(event.event_case());
      names += (names.empty() ? "" : " ") + field->name();
    }
    return names;
  }
  std::vector<std::string> images() const {
    std::vector<std::string> all;
    for (const v1::RenderEvent& event : events) {
      if (event.has_image_begin()) all.emplace_back();
      if (event.has_image_chunk()) all.back() += event.image_chunk().data();
    }
    return all;
  }
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReader<v1::RenderEvent>> reader;
  std::vector<v1::RenderEvent> events;
};

class ServiceTest : public ::testing::Test {
 protected:
  ServiceTest() { options.listen = {"127.0.0.1:0"}; }
  ~ServiceTest() override {
    renderer->gate.open();  // nobody waits for a test that failed
    scenes.gate.open();
  }

  void start() {
    options.onEnd = [this](const CallRecord& record) { records.add(record); };
    auto started = Server::start(options, std::make_unique<FakeRenderer>(renderer), scenes.source());
    ASSERT_TRUE(started) << started.error().message;
    server = std::move(*started);
    stub = client();
  }
  // Another connection: another client.
  std::unique_ptr<v1::Sundial::Stub> client() { return v1::Sundial::NewStub(channel()); }
  std::shared_ptr<grpc::Channel> channel() {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    return grpc::CreateCustomChannel(server->addresses().front(), grpc::InsecureChannelCredentials(),
                                     arguments);
  }
  grpc::Status render(const v1::RenderRequest& request) { return Stream(*stub, request).finish(); }

  ServerOptions options;
  std::shared_ptr<FakeState> renderer = std::make_shared<FakeState>();
  FakeScenes scenes;
  Records records;
  std::unique_ptr<Server> server;  // ends before what it reports to
  std::unique_ptr<v1::Sundial::Stub> stub;
};

}  // namespace sundial::test
