// sundiald: reads its flags, takes a device, serves until it is told to stop.
#include <fmt/format.h>
#include <grpc/grpc.h>
#include <grpc/support/log.h>
#include <signal.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>

#include "flags.h"
#include "metrics.h"
#include "renderer.h"
#include "service/server.h"
#include "service/status.h"

namespace {

using namespace sundial;

int die(int status, const Error& error) {
  fmt::print(stderr, "sundiald: {}\n", error.message);
  return status;
}

int listDevices() {
  const auto devices = Renderer::devices();
  if (!devices) return die(1, devices.error());
  for (std::size_t i = 0; i < devices->size(); ++i) {
    fmt::print("{}  {}  ({})\n", i, (*devices)[i].name, (*devices)[i].driver);
  }
  return 0;
}

SceneSource sceneSource() {
  return {[](const std::filesystem::path& path, const SceneLimits& limits) {
            return readSceneFiles(path, limits);
          },
          [](const SceneFiles& files, const SceneLimits& limits) { return parseGltf(files, limits); },
          [](std::string_view reference) { return makeBuiltin(reference); }, builtinScenes()};
}

// One line a call, as key=value.
void log(const CallRecord& call) {
  const auto level = call.status == grpc::StatusCode::OK ? spdlog::level::info : spdlog::level::warn;
  spdlog::log(
      level,
      "call id={} rpc={} client={:?} status={} total_ms={:.1f} render_ms={:.1f} bytes={} subject={:?} "
      "message={:?}",
      call.id, call.rpc, call.client, statusName(call.status), call.totalMs, call.renderMs, call.bytesSent,
      call.subject, call.message);
}

void setUpLog(const std::string& level) {
  auto logger =
      std::make_shared<spdlog::logger>("sundiald", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(std::move(logger));
  // gRPC's own messages repeat what errors say already: only for those who debug.
  gpr_set_log_function([](gpr_log_func_args* message) { spdlog::debug("grpc {}", message->message); });
}

}  // namespace

int main(int argc, char** argv) {
  std::string text;
  auto parsed = parseFlags(argc, argv, text);
  if (!parsed) return die(2, parsed.error());
  if (!*parsed) {
    fmt::print("{}", text);
    return 0;
  }
  Flags flags = std::move(**parsed);
  if (flags.listDevices) return listDevices();
  setUpLog(flags.logLevel);

  // Signals are waited for below; blocked here, before there are threads to inherit the mask.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  grpc_init();  // and no shutdown: at its end gRPC waits for a poller of its own, up to ten seconds

  std::unique_ptr<Metrics> metrics;
  if (!flags.metricsAddress.empty()) {
    auto serving = Metrics::serve(flags.metricsAddress);
    if (!serving) return die(1, serving.error());
    metrics = std::move(*serving);
  }
  auto renderer = Renderer::create(flags.device, flags.validation);
  if (!renderer) return die(1, renderer.error());

  flags.server.onEnd = [&metrics](const CallRecord& call) {
    log(call);
    if (metrics) metrics->count(call);
  };
  std::atomic<bool> broken = false;
  flags.server.onBroken = [&broken](const std::string& why) {
    spdlog::critical("the device fails again and again, stopping: {}", why);
    broken = true;
    ::kill(::getpid(), SIGTERM);
  };
  auto server = Server::start(std::move(flags.server), std::move(*renderer), sceneSource());
  if (!server) return die(server.error().code == ErrorCode::invalidArgument ? 2 : 1, server.error());
  if (metrics) metrics->watch(server->get());
  const DeviceInfo& device = (*server)->queue().device();
  spdlog::info("device name={:?} driver={:?}", device.name, device.driver);
  for (const std::string& address : (*server)->addresses()) spdlog::info("listening on {}", address);

  int signal = 0;
  sigwait(&signals, &signal);
  spdlog::info("stopping signal={} waiting={} rendering={}", signal, (*server)->queue().counts().waiting,
               (*server)->queue().counts().rendering);
  (*server)->stop(flags.drain);
  if (metrics) metrics->watch(nullptr);
  spdlog::info("stopped");
  return broken ? 1 : 0;
}
