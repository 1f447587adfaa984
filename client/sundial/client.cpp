#include "sundial/client.h"

#include <fmt/format.h>

#include <fstream>

namespace sundial::client {
namespace {

constexpr std::size_t kChunkBytes = 256 * 1024;

template <class Request, class Response>
using Rpc = grpc::Status (v1::Sundial::Stub::*)(grpc::ClientContext*, const Request&, Response*);

template <class Request, class Response>
Expected<Response> call(v1::Sundial::Stub& stub, const CallOptions& options, Rpc<Request, Response> rpc,
                        const Request& request) {
  Response response;
  const auto done = withRetries(
      options, [&](grpc::ClientContext& context) { return (stub.*rpc)(&context, request, &response); });
  if (!done) return std::unexpected(done.error());
  return response;
}

template <class Request, class Event>
using Stream = std::unique_ptr<grpc::ClientReader<Event>> (v1::Sundial::Stub::*)(grpc::ClientContext*,
                                                                                 const Request&);

// A stream's events, put together: `before` sees each event, `after` the assembler that has taken it.
template <class Assembler, class Event, class Request, class Before, class After>
auto assembled(v1::Sundial::Stub& stub, const CallOptions& options, Stream<Request, Event> rpc,
               const Request& request, const Before& before, const After& after)
    -> decltype(std::declval<Assembler&>().finish()) {
  decltype(std::declval<Assembler&>().finish()) whole;
  const auto done = withRetries(options, [&](grpc::ClientContext& context) -> grpc::Status {
    Assembler assembler(request);
    const auto reader = (stub.*rpc)(&context, request);
    Event event;
    while (reader->Read(&event)) {
      before(event);
      if (const grpc::Status added = assembler.add(std::move(event)); !added.ok()) {
        context.TryCancel();
        reader->Finish();  // its CANCELLED is ours; the damage is the news
        return added;
      }
      after(assembler);
    }
    if (const grpc::Status ended = reader->Finish(); !ended.ok()) return ended;
    whole = assembler.finish();
    return whole ? grpc::Status::OK : grpc::Status(whole.error().code, whole.error().message);
  });
  if (!done) return std::unexpected(done.error());
  return whole;
}

// Writes until everything is sent or the server ends the call; its status says why. An error of our own is
// for what can't be read.
grpc::Status sendFiles(const SceneFiles& scene, grpc::ClientWriter<v1::UploadSceneRequest>& writer,
                       const OnProgress& onProgress) {
  v1::UploadSceneRequest request;
  Progress progress{.bytesExpected = scene.bytes};
  request.set_main(scene.files.front().uri);
  if (!writer.Write(request)) return grpc::Status::OK;
  for (const SceneFile& file : scene.files) {
    request.set_file(file.uri);
    if (!writer.Write(request)) return grpc::Status::OK;
    std::ifstream input(file.path, std::ios::binary);
    std::string chunk(kChunkBytes, '\0');
    while (input) {
      input.read(chunk.data(), static_cast<std::streamsize>(kChunkBytes));
      if (input.bad() || (input.fail() && !input.eof())) break;
      const auto count = static_cast<std::size_t>(input.gcount());
      if (count == 0) break;
      request.set_chunk(chunk.data(), count);
      if (!writer.Write(request)) return grpc::Status::OK;
      progress.bytes += count;
      if (onProgress) onProgress(progress);
    }
    if (!input.eof())
      return {grpc::DATA_LOSS,
              fmt::format("reading {} failed on the way; check the disk", file.path.string())};
  }
  if (progress.bytes != scene.bytes)
    return {grpc::DATA_LOSS, "the scene's files changed while they were sent; send them again"};
  writer.WritesDone();
  return grpc::Status::OK;
}

}  // namespace

Client::Client(std::shared_ptr<grpc::Channel> channel, CallOptions options)
    : stub_(v1::Sundial::NewStub(std::move(channel))), options_(std::move(options)) {}

Expected<v1::ServerInfo> Client::serverInfo() const {
  return call<v1::GetServerInfoRequest, v1::ServerInfo>(*stub_, options_, &v1::Sundial::Stub::GetServerInfo,
                                                        {});
}

Expected<v1::ListMethodsResponse> Client::listMethods() const {
  return call<v1::ListMethodsRequest, v1::ListMethodsResponse>(*stub_, options_,
                                                               &v1::Sundial::Stub::ListMethods, {});
}

Expected<v1::ListScenesResponse> Client::listScenes() const {
  return call<v1::ListScenesRequest, v1::ListScenesResponse>(*stub_, options_, &v1::Sundial::Stub::ListScenes,
                                                             {});
}

Expected<v1::SceneInfo> Client::load(const std::string& scene) const {
  v1::LoadSceneRequest request;
  request.set_scene(scene);
  return call(*stub_, options_, &v1::Sundial::Stub::LoadScene, request);
}

Expected<v1::UnloadSceneResponse> Client::unload(const std::string& scene) const {
  v1::UnloadSceneRequest request;
  request.set_scene(scene);
  return call(*stub_, options_, &v1::Sundial::Stub::UnloadScene, request);
}

Expected<v1::ListStabilityCasesResponse> Client::stabilityCases() const {
  return call<v1::ListStabilityCasesRequest, v1::ListStabilityCasesResponse>(
      *stub_, options_, &v1::Sundial::Stub::ListStabilityCases, {});
}

Expected<v1::SceneInfo> Client::upload(const SceneFiles& scene, const OnProgress& onProgress) const {
  v1::SceneInfo info;
  const auto done = withRetries(options_, [&](grpc::ClientContext& context) {
    const auto writer = stub_->UploadScene(&context, &info);
    const grpc::Status sent = sendFiles(scene, *writer, onProgress);
    if (!sent.ok()) context.TryCancel();
    const grpc::Status answer = writer->Finish();
    return sent.ok() ? answer : sent;
  });
  if (!done) return std::unexpected(done.error());
  return info;
}

Expected<Rendering> Client::render(const v1::RenderRequest& request, const OnProgress& onProgress) const {
  Progress progress;
  return assembled<RenderingAssembler, v1::RenderEvent>(
      *stub_, options_, &v1::Sundial::Stub::Render, request,
      [&](const v1::RenderEvent& event) {
        if (event.has_accepted()) progress = {.queuePosition = event.accepted().queue_position()};
      },
      [&](const RenderingAssembler& assembler) {
        progress.bytes = assembler.bytesReceived();
        progress.bytesExpected = assembler.bytesExpected();
        progress.methodsDone = assembler.methodsDone();
        if (onProgress) onProgress(progress);
      });
}

Expected<Stability> Client::stability(
    const v1::StabilityRequest& request,
    const std::function<void(double done, double total)>& onProgress) const {
  return assembled<StabilityAssembler, v1::StabilityEvent>(
      *stub_, options_, &v1::Sundial::Stub::Stability, request, [](const v1::StabilityEvent&) {},
      [&](const StabilityAssembler& assembler) {
        if (onProgress) onProgress(assembler.framesDone(), assembler.frames());
      });
}

}  // namespace sundial::client
