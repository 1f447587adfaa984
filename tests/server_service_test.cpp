// What the server tells of itself, and how it starts and stops.
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <future>

#include "service/server.h"
#include "support/test_server.h"

namespace sundial {
namespace {

using namespace test;
using std::chrono::milliseconds;

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
