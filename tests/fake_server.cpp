#include "fake_server.h"

#include <grpc/grpc.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/security/server_credentials.h>
#include <grpcpp/server_builder.h>

#include <cstdlib>
#include <span>
#include <stdexcept>

#include "sundial/content_digest.h"
#include "sundial/crc32c.h"
#include "synthetic_scene.h"

namespace sundial::test {

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "sundial-test-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("can't make a temporary folder");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() { std::filesystem::remove_all(path_); }

FakeServer::FakeServer() : FakeServer(std::string()) {}

FakeServer::FakeServer(std::string address)
    : address_(address.empty() ? "unix:" + (folder_.path() / "s").string() : std::move(address)) {
  grpc_init();  // and no shutdown: with the last server gRPC waits for a poller of its own, up to ten seconds
  grpc::EnableDefaultHealthCheckService(true);
  grpc::ServerBuilder builder;
  builder.AddListeningPort(address_, grpc::InsecureServerCredentials(), &port_);
  builder.SetSyncServerOption(grpc::ServerBuilder::CQ_TIMEOUT_MSEC,
                              100);  // else a shutdown may take ten seconds
  builder.RegisterService(this);
  server_ = builder.BuildAndStart();
  if (!server_) throw std::runtime_error("can't listen at " + address_);
}

FakeServer::~FakeServer() { server_->Shutdown(std::chrono::system_clock::now()); }

grpc::Status FakeServer::misbehave(grpc::ServerContext& context) {
  if (queueFull-- > 0) {
    context.AddTrailingMetadata("sundial-retry-ms", "1");
    return {grpc::RESOURCE_EXHAUSTED, "the queue is full; retry in 1 ms"};
  }
  if (lost-- > 0) return {grpc::UNAVAILABLE, "the server is stopping; retry elsewhere"};
  return refusal;
}

void FakeServer::forget() {
  const std::lock_guard lock(mutex_);
  digests_.clear();
}

// A scene by its digest must have come first; all others are the one that there is.
bool FakeServer::knows(const std::string& scene) {
  const std::lock_guard lock(mutex_);
  return !scene.starts_with("digest:") || digests_.contains(scene.substr(7));
}

grpc::Status FakeServer::ListMethods(grpc::ServerContext*, const v1::ListMethodsRequest*,
                                     v1::ListMethodsResponse* response) {
  v1::Method& sm = *response->add_methods();
  sm.set_name("sm");
  sm.set_title("Standard shadow map");
  sm.set_source("Williams 1978");
  (*sm.mutable_stages())["volume"] = "scene";
  (*sm.mutable_stages())["lookup"] = "hard";
  v1::Parameter& texels = *sm.add_parameters();
  texels.set_name("texels");
  texels.set_kind("size");
  texels.set_unit("texels");
  texels.set_min(16);
  texels.set_max(16384);
  texels.set_default_value("2048");
  texels.set_description("size of every map");
  v1::Method& traced = *response->add_methods();
  traced.set_name("ray-traced");
  traced.set_title("A ray per view sample");
  return grpc::Status::OK;
}

grpc::Status FakeServer::GetServerInfo(grpc::ServerContext*, const v1::GetServerInfoRequest*,
                                       v1::ServerInfo* info) {
  info->set_device("fake device");
  info->set_driver("fake driver 1.0");
  return grpc::Status::OK;
}

grpc::Status FakeServer::ListScenes(grpc::ServerContext*, const v1::ListScenesRequest*,
                                    v1::ListScenesResponse* response) {
  v1::SceneInfo& scene = *response->add_scenes();
  scene.set_reference("builtin:discs");
  scene.set_description("discs above a plane");
  scene.add_views("default");
  const std::lock_guard lock(mutex_);
  for (const std::string& digest : digests_) {
    v1::SceneInfo& uploaded = *response->add_scenes();
    uploaded.set_reference("digest:" + digest);
    uploaded.set_digest(digest);
    uploaded.set_loaded(true);
  }
  return grpc::Status::OK;
}

grpc::Status FakeServer::LoadScene(grpc::ServerContext*, const v1::LoadSceneRequest* request,
                                   v1::SceneInfo* info) {
  if (request->scene() != "builtin:discs")
    return {grpc::NOT_FOUND, "scene '" + request->scene() + "' isn't there;\nthere is builtin:discs"};
  info->set_reference(request->scene());
  info->set_loaded(true);
  info->set_triangles(12);
  return grpc::Status::OK;
}

grpc::Status FakeServer::UploadScene(grpc::ServerContext* context,
                                     grpc::ServerReader<v1::UploadSceneRequest>* reader,
                                     v1::SceneInfo* info) {
  ++uploads;
  if (const grpc::Status status = misbehave(*context); !status.ok()) return status;
  uploaded.clear();
  std::string* open = nullptr;
  v1::UploadSceneRequest part;
  while (reader->Read(&part)) {
    if (part.has_main()) uploadedMain = part.main();
    if (part.has_file()) open = &uploaded[part.file()];
    if (!part.has_chunk()) continue;
    if (!open) return {grpc::INVALID_ARGUMENT, "a chunk of no file"};
    *open += part.chunk();
    largestChunk = std::max(largestChunk, part.chunk().size());
  }
  ContentDigest digest;
  digest.add("files");
  digest.add(uploaded[uploadedMain]);
  for (const auto& [name, content] : uploaded) {
    if (name == uploadedMain) continue;
    digest.add(name);
    digest.add(content);
  }
  info->set_digest(digest.hexadecimal());
  info->set_reference("digest:" + info->digest());
  const std::lock_guard lock(mutex_);
  digests_.insert(info->digest());
  info->set_loaded(true);
  return grpc::Status::OK;
}

grpc::Status FakeServer::UnloadScene(grpc::ServerContext*, const v1::UnloadSceneRequest*,
                                     v1::UnloadSceneResponse*) {
  return grpc::Status::OK;
}

grpc::Status FakeServer::Render(grpc::ServerContext* context, const v1::RenderRequest* request,
                                grpc::ServerWriter<v1::RenderEvent>* writer) {
  ++renderings;
  {
    const std::lock_guard lock(mutex_);
    lastRequest = *request;
  }
  if (const grpc::Status status = misbehave(*context); !status.ok()) return status;
  if (const grpc::Status status = judge ? judge(*request) : grpc::Status::OK; !status.ok()) return status;
  if (!knows(request->scene()))
    return {grpc::NOT_FOUND, "scene '" + request->scene() + "' isn't loaded: upload it again"};
  constexpr std::size_t kChunkBytes = 256 * 1024;

  // False once the stream is to end.
  bool going = true;
  const auto send = [&](v1::RenderEvent event) {
    if (going && tamper) going = tamper(event);
    if (going) going = writer->Write(event);
  };
  v1::RenderEvent event;
  *event.mutable_accepted() = acceptedOf(*request);
  send(event);
  if (hang) {
    hang();
    while (writer->Write(v1::RenderEvent())) continue;
    return {grpc::CANCELLED, "the client went away"};
  }
  const SyntheticScene scene(*request);
  for (int m = 0; m < request->methods_size(); ++m) {
    const auto method = static_cast<unsigned>(m);
    event.mutable_layout()->set_method(method);
    *event.mutable_layout()->mutable_plan() = scene.plan(request->methods(m));
    send(event);
    for (const int aov : request->images()) {
      const std::string bytes = scene.image(request->methods(m), static_cast<v1::Aov>(aov));
      v1::ImageBegin& begin = *event.mutable_image_begin();
      begin.set_method(method);
      begin.set_aov(static_cast<v1::Aov>(aov));
      begin.set_width(request->width());
      begin.set_height(request->height());
      begin.set_bytes(bytes.size());
      send(event);
      for (std::size_t at = 0; at < bytes.size(); at += kChunkBytes) {
        event.mutable_image_chunk()->set_data(bytes.substr(at, kChunkBytes));
        send(event);
      }
      event.mutable_image_end()->set_crc32c(crc32c(std::as_bytes(std::span(bytes))));
      send(event);
    }
    event.mutable_timings()->set_method(method);
    *event.mutable_timings()->mutable_result() = scene.result(request->methods(m));
    event.mutable_timings()->mutable_result()->set_repetitions(request->repetitions());
    send(event);
  }
  event.mutable_done();
  send(event);
  return going ? grpc::Status::OK : brokenOff;
}

grpc::Status FakeServer::Stability(grpc::ServerContext* context, const v1::StabilityRequest* request,
                                   grpc::ServerWriter<v1::StabilityEvent>* writer) {
  ++runs;
  {
    const std::lock_guard lock(mutex_);
    lastRun = *request;
  }
  if (const grpc::Status status = misbehave(*context); !status.ok()) return status;
  if (const grpc::Status status = judgeRun ? judgeRun(*request) : grpc::Status::OK; !status.ok())
    return status;
  if (!knows(request->scene()))
    return {grpc::NOT_FOUND, "scene '" + request->scene() + "' isn't loaded: upload it again"};
  if (request->has_path_name() && request->path_name() != "walk")
    return {grpc::NOT_FOUND, "the scene has no path '" + request->path_name() + "': it has walk"};

  v1::RenderRequest first;
  first.set_scene(request->scene());
  v1::View& view = *first.mutable_view();
  view.mutable_eye()->set_y(1);
  view.mutable_target()->set_z(-4);
  view.mutable_up()->set_y(1);
  view.set_vertical_fov_degrees(70);
  bool going = true;
  const auto send = [&](v1::StabilityEvent event) {
    if (going && tamperRun) going = tamperRun(event);
    if (going) going = writer->Write(event);
  };
  v1::StabilityEvent event;
  *event.mutable_accepted() = acceptedOf(first);
  send(event);
  for (int m = 0; m < request->methods_size(); ++m) {
    event.mutable_outcome()->set_method(static_cast<unsigned>(m));
    v1::StabilityResult& result = *event.mutable_outcome()->mutable_result();
    result.set_method(request->methods(m).name());
    result.set_flip_rate(request->methods(m).name() == "sm" ? 0 : 0.25);
    result.set_points(request->points());
    for (unsigned frame = 0; frame < request->frames(); ++frame) result.add_flips_per_frame(0);
    send(event);
  }
  event.mutable_done();
  send(event);
  return going ? grpc::Status::OK : brokenOff;
}

}  // namespace sundial::test
