// sundial sweep: many cases over one server or several, one line of results each.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

#include "command/command.h"
#include "command/failure.h"
#include "command/json.h"
#include "sweep/case_runner.h"
#include "sweep/cases.h"
#include "sweep/in_parallel.h"
#include "sweep/line.h"
#include "sweep/pictures.h"
#include "sweep/results_file.h"

namespace sundial::command {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;
constexpr unsigned kInFlight =
    4;  // cases at each server: one is rendered, the next ones wait, whoever is slow

struct Options {
  std::string spec, output, images, shard;
  bool resume = false;
  double patienceSeconds = 300;
};

sweep::Shard parseShard(const std::string& text) {
  if (text.empty()) return {};
  sweep::Shard shard;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  const bool slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, shard.count) : first;
  if (!slash || second.ec != std::errc() || second.ptr != end || shard.index < 1 || shard.index > shard.count)
    throw refusal(
        fmt::format("--shard: '{}' is no part of a whole; write I/N with I in [1, N], e.g. 2/8", text));
  return shard;
}

fs::path resultsPath(const Options& options, const sweep::Shard& shard) {
  if (!options.output.empty()) return options.output;
  const std::string stem = fs::path(options.spec).stem().string();
  return shard.count == 1 ? stem + ".jsonl"
                          : fmt::format("{}-{}-of-{}.jsonl", stem, shard.index, shard.count);
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error) && !fs::create_directories(folder, error))
    throw refusal(fmt::format("--images: can't make the folder {}: {}; choose another", folder.string(),
                              error ? error.message() : "a file is in its place"));
  if (const auto why = image::whyUnwritable(folder / "x.jpg")) throw refusal("--images: " + *why);
}

std::string duration(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 90 * 60) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

// How many cases the servers have room for. One that doesn't answer now may do so later.
unsigned casesInFlight(const std::vector<std::shared_ptr<grpc::Channel>>& servers,
                       client::CallOptions options) {
  options.timeout = std::min<std::chrono::milliseconds>(options.timeout, std::chrono::seconds(10));
  options.lostRetries = 0;
  unsigned sum = 0;
  for (const auto& server : servers) {
    const auto info = client::Client(server, options).serverInfo();
    const unsigned room = info ? info->max_queued_per_client() : 0;
    sum += room == 0 ? kInFlight : std::min(room, kInFlight);
  }
  return sum;
}

// Takes results as they come, and counts. Any thread.
class Results {
 public:
  Results(sweep::ResultsFile& file, v1::SweepSummary& summary, bool quiet)
      : file_(file), summary_(summary), bar_("Sweeping", quiet) {}

  void add(const v1::SweepLine& line) {
    const std::string text = toJsonLine(line);
    const std::lock_guard lock(mutex_);
    file_.append(text);
    summary_.set_rendered(summary_.rendered() + 1);
    if (line.has_error()) summary_.set_failed(summary_.failed() + 1);
    if (line.has_error() && firstError_.empty())
      firstError_ = fmt::format("{} {}: {}", line.scene(), line.method(), line.error().message());
    show();
  }
  const std::string& firstError() const { return firstError_; }

 private:
  void show() {
    const double done = summary_.resumed() + summary_.rendered();
    const double left = summary_.cases() - done;
    const double seconds = std::chrono::duration<double>(steady_clock::now() - begin_).count();
    std::string note = fmt::format("{:.0f} of {}, {} left", done, summary_.cases(),
                                   duration(left * seconds / summary_.rendered()));
    if (summary_.failed() > 0) note += fmt::format(", {} failed", summary_.failed());
    bar_.show(done, summary_.cases(), note);
  }

  std::mutex mutex_;
  sweep::ResultsFile& file_;
  v1::SweepSummary& summary_;
  ProgressBar bar_;
  const steady_clock::time_point begin_ = steady_clock::now();
  std::string firstError_;
};

v1::SweepLine measured(const sweep::Case& one, sweep::CaseRunner& runner, const Options& options,
                       const fs::path& resultsFile) {
  v1::RenderRequest request = one.request;
  std::optional<client::Stability> along;
  if (one.along) {
    auto run = runner.stability(*one.along);
    if (!run) return makeLine(one, run.error());
    along = std::move(*run);
    *request.mutable_view() = along->accepted.view();
    *request.mutable_light() = along->accepted.light();
  }
  if (!options.images.empty())
    for (const v1::Aov aov : sweep::kPictureImages) request.add_images(aov);
  const auto rendering = runner.render(request);
  if (!rendering) return makeLine(one, rendering.error());
  v1::SweepLine line = makeLine(one, *rendering, along);
  if (options.images.empty()) return line;
  const auto pictures = sweep::makePictures(one, *rendering, options.images);
  image::writeFiles(pictures);
  *line.mutable_images() = sweep::pictureNames(pictures, resultsFile);
  return line;
}

void sweepCases(Session& session, const Options& options) {
  // Refuse what can be refused here.
  const sweep::Shard shard = parseShard(options.shard);
  const v1::SweepSpec spec = orRefuse(sweep::readSpec(options.spec));
  sweep::Cases cases = orRefuse(sweep::expand(spec, fs::path(options.spec).parent_path()));
  std::erase_if(cases.list, [&](const sweep::Case& one) { return !shard.has(one); });
  if (!options.images.empty()) makeFolder(options.images);
  const fs::path path = resultsPath(options, shard);
  sweep::ResultsFile file =
      orRefuse(options.resume ? sweep::ResultsFile::resume(path) : sweep::ResultsFile::create(path));

  v1::SweepSummary summary;
  summary.set_results(path.string());
  summary.set_cases(static_cast<std::uint32_t>(cases.list.size()));
  std::erase_if(cases.list, [&](const sweep::Case& one) {
    const auto done = file.done().find(one.id);
    if (done == file.done().end()) return false;
    summary.set_resumed(summary.resumed() + 1);
    summary.set_failed(summary.failed() + done->second);
    return true;
  });

  Results results(file, summary, session.options().quiet);
  if (!cases.list.empty()) {
    std::stop_source stop;
    client::CallOptions call = session.callOptions();
    const std::stop_callback interrupted(call.stop, [&] { stop.request_stop(); });
    call.stop = stop.get_token();
    const auto servers = session.eachServer();
    // A private server that is lost doesn't come back.
    const std::chrono::duration<double> patience(session.options().server.empty() ? 0
                                                                                  : options.patienceSeconds);
    sweep::SceneSupply supply(servers, call, cases.files);
    sweep::CaseRunner runner(session.channel(), supply, call,
                             std::chrono::duration_cast<std::chrono::milliseconds>(patience));
    try {
      sweep::inParallel(cases.list.size(), casesInFlight(servers, call), stop, [&](std::size_t i) {
        const v1::SweepLine line = measured(cases.list[i], runner, options, path);
        if (!stop.stop_requested()) results.add(line);
      });
    } catch (const sweep::ServersGone& gone) {
      throw failure(fmt::format("{}; {} of {} cases are in {}: start sundiald again and repeat with --resume",
                                gone.what(), summary.resumed() + summary.rendered(), summary.cases(),
                                path.string()));
    }
    if (stop.stop_requested()) throw failure("interrupted");
  }

  if (session.options().json) {
    printJson(summary);
  } else if (!session.options().quiet) {
    fmt::print("{}: {} cases, {} rendered, {} done before, {} failed\n", path.string(), summary.cases(),
               summary.rendered(), summary.resumed(), summary.failed());
  }
  if (summary.failed() > 0)
    throw failure(fmt::format(
        "{} of {} cases failed{}; their lines in {} say why", summary.failed(), summary.cases(),
        results.firstError().empty() ? "" : ", the first: " + results.firstError(), path.string()));
}

constexpr const char* kFooter = R"(Example:
  sundial --server a:50051,b:50051 sweep all.textproto -o results.jsonl --images pictures

A specification, in protobuf text format (every scene x size x view or path x light or light path
x method x value):
  group {
    scene: "builtin:grid"  scene: "./apartment.glb"
    size { width: 640 height: 480 }
    view { name: "main" }
    view { name: "mine" view { eye { x: 3 y: 2 z: 4 } target { y: 1 } } }
    light { name: "sun" }
    light { name: "steep" light { sun { direction { x: 0.1 y: -1 } } } }
    method { name: "sm" parameter { key: "texels" value: ["512", "1024", "2048"] } }
    method { name: "ray-traced" }
  }
  group {
    scene: "builtin:atrium"
    path { name: "walk" }  path { file: "turn.textproto" }
    method { name: "sm" }  method { name: "dv" }
    frames: 24  points: 2000  seed: 1
  }
Along a path of the camera (path) or the light (light_path) a case is measured as 'sundial stability'
does, and rendered at the first frame: its line has both. A file of keys is as in its help.
Without size, view or light: 1024x1024 and the scene's defaults. Outside of groups there may be
baseline: "sm,texels=2048", repetitions: 5, max_repetitions: 25 and quartile_target: 0.1: a case is
repeated until the quartiles of its time's ratio to the baseline's are as close as that. Without frames,
points or seed: as many frames as the path has, 4096 points, seed 1.

A case that failed counts as done, with its error; remove its line to have it rendered again.)";

}  // namespace

void addSweep(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("sweep", "Render many cases: scenes x views, lights or paths x methods x sizes");
  command->footer(kFooter);
  const auto options = std::make_shared<Options>();
  command->add_option("SPEC", options->spec, "file that says which cases")->required();
  command
      ->add_option("-o,--output", options->output,
                   "file for the results, one JSON line a case [SPEC's name with .jsonl]")
      ->type_name("RESULTS.jsonl");
  command->add_option("--images", options->images, "keep each case's picture, errors and plan in this folder")
      ->type_name("DIR");
  command->add_option("--shard", options->shard, "only part I of N; the parts' results are joined by cat")
      ->type_name("I/N");
  command->add_flag("--resume", options->resume, "go on with the results that there are; skip what is done");
  command
      ->add_option("--patience", options->patienceSeconds, "how long to wait while no server answers [300]")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.0, 1e6));
  command->callback(
      [&action, options] { action = [options](Session& session) { sweepCases(session, *options); }; });
}

}  // namespace sundial::command
