// What the service adds to a rendering: the whole call over gRPC (request, rendering, stream, images put
// together by the client) against the same rendering in process, in pairs whose order alternates.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <grpc/grpc.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>

#include "bench/program.h"
#include "renderer.h"
#include "scene/choose.h"
#include "scene/load.h"
#include "service/convert.h"
#include "service/server.h"
#include "sundial/client.h"
#include "sundial/connect.h"

namespace {

using namespace sundial;
using bench::need;

constexpr const char* kScene = "builtin:atrium";
constexpr unsigned kSide = 1024;
constexpr int kPairs = 15;

double millisecondsOf(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double quantile(std::vector<double> values, double q) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(std::lround(q * static_cast<double>(values.size() - 1)))];
}

// Keeps what a caller in process would.
struct Keeper final : JobSink {
  std::vector<Image> images;
  void onPlan(std::size_t, const std::vector<PlanView>&) override {}
  void onImage(std::size_t, Image image) override { images.push_back(std::move(image)); }
  void onResult(std::size_t, MethodResult) override {}
};

// A folder for a socket, gone with this.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / fmt::format("sundial-bench-{}", ::getpid())) {
    std::filesystem::create_directory(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string socket() const { return fmt::format("unix:{}/socket", path_.string()); }

 private:
  const std::filesystem::path path_;
};

// The same scene and device twice: behind a server, and here.
class Bench {
 public:
  Bench() : renderer_(need(Renderer::create("", false))) {
    scene_ = std::make_shared<const Scene>(need(makeBuiltin("atrium")));
    ServerOptions options;
    options.listen = {folder_.socket(), "127.0.0.1:0"};
    options.onEnd = [this](const CallRecord& call) {
      renderMs_ = call.renderMs;
      ++ended_;
      ended_.notify_one();
    };
    SceneSource source;
    source.generate = [](std::string_view reference) { return makeBuiltin(reference); };
    server_ = need(Server::start(std::move(options), need(Renderer::create("", false)), source));
  }

  void renderHere(const std::vector<Aov>& images) {
    RenderJob job{.scene = scene_, .size = {kSide, kSide}, .methods = {need(parseMethod("sm"))}};
    job.view = need(chooseView(*scene_, {}));
    job.light = need(chooseLight(*scene_, {}));
    job.images = images;
    Keeper keeper;
    need(renderer_->run(job, {}, keeper));
    benchmark::DoNotOptimize(keeper.images.data());
  }

  client::Client connect(std::size_t address) const {
    const auto channel = client::connect(server_->addresses()[address]);
    if (!channel) throw std::runtime_error(channel.error().message);
    return client::Client(*channel);
  }

  void renderThere(const client::Client& client, const std::vector<Aov>& images) {
    v1::RenderRequest request;
    request.set_scene(kScene);
    request.set_width(kSide);
    request.set_height(kSide);
    request.add_methods()->set_name("sm");
    for (const Aov aov : images) request.add_images(toProto(aov));
    const auto rendering = client.render(request);
    if (!rendering) throw std::runtime_error(rendering.error().message);
    ++calls_;
  }
  // Of the last call: what of it the device's thread was busy. The server's account comes a moment after the
  // client has all.
  double renderMs() const {
    for (unsigned ended = ended_; ended != calls_; ended = ended_) ended_.wait(ended);
    return renderMs_;
  }

 private:
  Folder folder_;
  std::atomic<double> renderMs_ = 0;
  std::atomic<unsigned> ended_ = 0;
  unsigned calls_ = 0;
  std::unique_ptr<Renderer> renderer_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Server> server_;
};

void timePairs(benchmark::State& state, Bench& bench, std::size_t address, const std::vector<Aov>& images) {
  const client::Client client = bench.connect(address);
  const auto here = [&] { bench.renderHere(images); };
  const auto there = [&] { bench.renderThere(client, images); };
  here();  // not the first of its kind
  there();
  std::vector<double> hereMs, ratios, beside;
  bool hereFirst = true;
  for ([[maybe_unused]] auto _ : state) {
    double a = hereFirst ? millisecondsOf(here) : 0;
    const double b = millisecondsOf(there);
    if (!hereFirst) a = millisecondsOf(here);
    hereFirst = !hereFirst;
    state.SetIterationTime(b / 1000);
    hereMs.push_back(a);
    ratios.push_back(b / a);
    beside.push_back(b - bench.renderMs());
  }
  state.counters["in_process_ms"] = quantile(hereMs, 0.5);
  state.counters["beside_rendering_ms"] = quantile(beside, 0.5);  // of the call, what isn't rendering
  state.counters["ratio"] = quantile(ratios, 0.5);
  state.counters["ratio_q1"] = quantile(ratios, 0.25);
  state.counters["ratio_q3"] = quantile(ratios, 0.75);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  grpc_init();  // and no shutdown: at its end gRPC waits for a poller of its own, up to ten seconds
  try {
    Bench bench;
    const std::pair<const char*, std::vector<Aov>> outputs[] = {
        {"colour", {Aov::colour}},
        {"colour+visibility+position", {Aov::colour, Aov::visibility, Aov::position}}};
    for (const auto& [name, images] : outputs)
      for (const std::size_t address : {0, 1})
        benchmark::RegisterBenchmark(
            fmt::format("call/{}/{}", address == 0 ? "unix" : "tcp", name).c_str(),
            [&bench, address, images](benchmark::State& state) { timePairs(state, bench, address, images); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(kPairs);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
  } catch (const std::exception& failed) {
    fmt::print(stderr, "sundial-bench-service: {}\n", failed.what());
    return 1;
  }
}
