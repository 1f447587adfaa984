// sundial stability: how steady shadows are while the camera or the light moves.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "command/command.h"
#include "command/failure.h"
#include "command/folder.h"
#include "command/json.h"
#include "command/verdict.h"
#include "command/view_options.h"
#include "page/stability_page.h"
#include "page/units.h"
#include "sundial/method_choice.h"
#include "sundial/read_text.h"

namespace sundial::command {
namespace {

constexpr unsigned kPictures = 8;  // of each method, with -o

struct Options {
  std::string scene, path, lightPath, named, output;
  std::vector<std::string> methods;
  unsigned frames = 0, points = 4096;
  bool pixels = false;
  std::uint64_t seed = 1;
  ViewOptions view;
};

// One request, and where it comes from.
struct Task {
  v1::StabilityRequest request;
  std::optional<v1::StabilityCase> named;
  std::string label;
};

// What has a slash or a dot is a file; other words are names of the scene's own.
bool isFile(const std::string& path) { return path.find_first_of("/.") != std::string::npos; }

// What a run along a path is called.
std::string nameOf(const std::string& path) {
  return isFile(path) ? std::filesystem::path(path).stem().string() : path;
}

void readKeys(const std::string& option, const std::string& file, google::protobuf::Message& path) {
  if (const auto read = client::readText(file, path); !read)
    throw refusal(fmt::format("{}: {}; name a file of keys in protobuf text format, or a path of the scene",
                              option, read.error().message));
}

v1::StabilityRequest makeRequest(const Options& options) {
  v1::StabilityRequest request;
  v1::RenderRequest still;
  options.view.apply(still);
  request.set_width(still.width());
  request.set_height(still.height());
  if (!options.path.empty()) {
    if (still.view_choice_case() != v1::RenderRequest::VIEW_CHOICE_NOT_SET)
      throw refusal(
          "--path: the camera can't stand still at the same time; leave out --view, --eye, --target");
    if (isFile(options.path)) {
      readKeys("--path", options.path, *request.mutable_path());
    } else {
      request.set_path_name(options.path);
    }
  } else if (still.has_view()) {
    *request.mutable_view() = still.view();
  } else if (still.has_view_name()) {
    request.set_view_name(still.view_name());
  }
  if (!options.lightPath.empty()) {
    if (still.light_choice_case() != v1::RenderRequest::LIGHT_CHOICE_NOT_SET)
      throw refusal(
          "--light-path: the light can't stand still at the same time; leave out --light, --sun ...");
    if (isFile(options.lightPath)) {
      readKeys("--light-path", options.lightPath, *request.mutable_light_path());
    } else {
      request.set_light_path_name(options.lightPath);
    }
  } else if (still.has_light()) {
    *request.mutable_light() = still.light();
  } else if (still.has_light_name()) {
    request.set_light_name(still.light_name());
  }
  return request;
}

// What -o and the numbers add to any request.
void applyCommon(const Options& options, v1::StabilityRequest& request) {
  if (options.frames != 0) request.set_frames(options.frames);
  request.set_points(options.points);
  request.set_seed(options.seed);
  if (options.pixels) request.set_pixels(true);
  request.set_pictures(options.output.empty() ? 0 : kPictures);
}

std::vector<Task> namedTasks(const Options& options, const v1::ListStabilityCasesResponse& listed,
                             const std::vector<v1::MethodChoice>& methods) {
  std::vector<Task> tasks;
  std::vector<std::string> names;
  for (v1::StabilityCase row : listed.cases()) {
    names.push_back(row.name());
    if (options.named != "all" && options.named != row.name()) continue;
    for (v1::StabilityRequest* request :
         {row.mutable_request(), row.has_twin() ? row.mutable_twin() : nullptr}) {
      if (!request) continue;
      for (const v1::MethodChoice& method : methods) *request->add_methods() = method;
      applyCommon(options, *request);
    }
    if (row.has_twin()) row.mutable_twin()->set_pictures(0);
    tasks.push_back({row.request(), row, row.name()});
  }
  if (tasks.empty())
    throw failure(
        fmt::format("--case: there is no '{}'; there are: all, {}", options.named, fmt::join(names, ", ")));
  return tasks;
}

v1::StabilityReport::Case makeCase(const Task& task, const std::string& scene,
                                   const std::vector<client::MethodStability>& methods,
                                   const std::vector<client::MethodStability>& twin, const Options& options) {
  v1::StabilityReport::Case report;
  report.set_case_(task.label);
  report.set_scene(scene);
  report.set_path(task.request.has_path() ? options.path : task.request.path_name());
  report.set_light_path(task.request.has_light_path() ? options.lightPath : task.request.light_path_name());
  report.add_size(task.request.width());
  report.add_size(task.request.height());
  for (const client::MethodStability& method : methods) *report.add_results() = method.result;
  for (const client::MethodStability& method : twin) *report.add_twin() = method.result;
  if (task.named) *report.mutable_verdict() = judge(*task.named, report.results(), report.twin());
  return report;
}

void printTable(const page::StabilityRun& run) {
  std::size_t width = 6;
  for (const std::string& label : run.labels) width = std::max(width, label.size());
  fmt::print("{}: {}, {} frames, {} x {}\n", run.report.case_(), run.report.scene(),
             run.report.results(0).flips_per_frame_size(), run.report.size(0), run.report.size(1));
  if (!run.sentence.empty()) fmt::print("{}\n", run.sentence);
  fmt::print("\n{:<{}}  {:>10} {:>10} {:>10} {:>10} {:>8} {:>9}{}\n", "method", width, "flip rate", "pop",
             "texel jump", "wrong", "points", "pairs", run.pixels ? "  wrong pixels" : "");
  for (std::size_t i = 0; i < run.labels.size(); ++i) {
    const v1::StabilityResult& result = run.report.results(static_cast<int>(i));
    fmt::print("{:<{}}  {:>10} {:>10} {:>10} {:>10} {:>8.0f} {:>9.0f}{}\n", run.labels[i], width,
               page::percent(result.flip_rate()), page::percent(result.pop()),
               page::significant(result.texel_jump()), page::percent(result.wrong_rate()), result.points(),
               result.pairs(),
               run.pixels ? fmt::format(" {:>13}", page::percent(result.wrong_pixels())) : "");
  }
  if (run.report.has_verdict())
    fmt::print("{}: {}\n", run.report.verdict().good() ? "good" : "NOT GOOD", run.report.verdict().why());
  fmt::print("\n");
}

void stability(Session& session, const Options& options) {
  // Refuse what can be refused here.
  std::vector<v1::MethodChoice> methods;
  for (const std::string& method : options.methods)
    methods.push_back(orRefuse(client::parseMethodChoice(method)));
  std::vector<Task> tasks;
  if (options.named.empty()) {
    if (options.scene.empty()) throw refusal("SCENE is missing; name one, or a case with --case");
    if (methods.empty()) throw refusal("--method is missing; give one or more, see 'sundial methods'");
    if (options.path.empty() && options.lightPath.empty())
      throw refusal("nothing moves; give --path, --light-path or both, see 'sundial stability --help'");
    v1::StabilityRequest request = makeRequest(options);
    for (const v1::MethodChoice& method : methods) *request.add_methods() = method;
    applyCommon(options, request);
    tasks.push_back({request, std::nullopt, nameOf(options.path.empty() ? options.lightPath : options.path)});
  } else if (!options.scene.empty() || !options.path.empty() || !options.lightPath.empty()) {
    throw refusal("--case brings its own scene and paths; leave out SCENE, --path and --light-path");
  }
  if (!options.output.empty()) makeFolder(options.output);

  if (!options.named.empty()) {
    tasks = namedTasks(options, session.answer(session.client().stabilityCases()), methods);
  } else {
    tasks.front().request.set_scene(session.sceneReference(options.scene));
  }

  v1::StabilityReport report;
  std::vector<page::StabilityRun> runs;
  std::string notGood;
  for (const Task& task : tasks) {
    auto results = session.stability(task.request, task.label);
    std::vector<client::MethodStability> twin;
    if (task.named && task.named->has_twin())
      twin = session.stability(task.named->twin(), task.label + "'s twin");
    auto& added = *report.add_cases();
    added = makeCase(task, task.named ? task.request.scene() : options.scene, results, twin, options);
    std::vector<std::string> labels;
    for (const v1::MethodChoice& method : task.request.methods())
      labels.push_back(client::methodLabel(method));
    runs.push_back(
        {added, std::move(results), labels, task.named ? task.named->sentence() : "", task.request.pixels()});
    if (!session.options().json) printTable(runs.back());
    if (options.output.empty()) runs.back().methods.clear();
    if (added.has_verdict() && !added.verdict().good())
      notGood += (notGood.empty() ? "" : ", ") + added.case_();
  }
  const v1::ServerInfo server = session.answer(session.client().serverInfo());
  report.set_device(server.device());
  report.set_driver(server.driver());
  if (!options.output.empty()) {
    image::writeFiles(page::stabilityFiles(options.output, runs, toJson(report)));
    if (!session.options().quiet && !session.options().json)
      fmt::print("{}\n", (std::filesystem::path(options.output) / "index.html").string());
  }
  if (session.options().json) printJson(report);
  if (!notGood.empty()) throw failure(fmt::format("not as it must be: {}", notGood));
}

}  // namespace

void addStability(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "stability", "Move the camera or the light, and count shadows that change although they shouldn't");
  command->footer(
      "flip rate: of fixed points on surfaces, seen in two frames in a row, the share whose shadow changes "
      "from "
      "one\nto the next while the ray-traced truth doesn't; pop: the largest share in one frame; texel jump: "
      "the "
      "largest\n|log2| of a shadow map's texel size from frame to frame; wrong: points' answers that aren't "
      "the "
      "truth;\nwrong pixels, with --pixels: the share of all frames' pixels that aren't.\n\n"
      "FILE (it has a dot or a slash) holds key frames in protobuf text format:\n"
      "  keys { eye { x: 1 y: 2 z: 3 } target {} vertical_fov_degrees: 60 }  keys { ... }  frames: 60\n"
      "and of a light path, e.g.:\n"
      "  keys { sun { direction { x: -1 y: -0.2 } } }  keys { sun { direction { y: -1 } } }  frames: 60\n\n"
      "With --case the exit status is 1 where a case isn't as it must be; --method adds methods to it.\n\n"
      "Examples:\n  sundial stability builtin:atrium --method sm --method dv --path walk -o out\n"
      "  sundial stability builtin:atrium --method sm --view main --light-path day\n"
      "  sundial stability --case all");
  const auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->scene, kSceneHelp);
  command->add_option("--method", options->methods, "one of those measured; repeat it for each")
      ->type_name(kMethodSyntax)
      ->allow_extra_args(false);
  command->add_option("--path", options->path, "the camera's way: a path of the scene, or a file")
      ->type_name("NAME|FILE");
  command
      ->add_option("--light-path", options->lightPath,
                   "the light's way: a light path of the scene, or a file")
      ->type_name("NAME|FILE");
  command->add_option("--case", options->named, "a named case where a method fails, or all of them")
      ->type_name("NAME|all");
  command->add_option("--frames", options->frames, "frames of the path, 1 to 2000 [as many as it has]")
      ->type_name("N")
      ->check(CLI::Range(1, 2000));
  command->add_option("--points", options->points, "points on surfaces, 1 to 65536 [4096]")
      ->type_name("N")
      ->check(CLI::Range(1, 65536));
  command->add_option("--seed", options->seed, "chooses the points [1]")->type_name("N");
  command->add_flag("--pixels", options->pixels, "hold every pixel of every frame against a ray, too");
  command
      ->add_option("-o,--output", options->output, "folder for strips of frames, report.json and index.html")
      ->type_name("DIR");
  options->view.addTo(*command, "512x512");
  command->callback(
      [&action, options] { action = [options](Session& session) { stability(session, *options); }; });
}

}  // namespace sundial::command
