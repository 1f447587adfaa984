// sundial compare: methods against the ray-traced reference, in numbers and as a page.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "command/command.h"
#include "command/failure.h"
#include "command/folder.h"
#include "command/json.h"
#include "command/report.h"
#include "command/view_options.h"
#include "page/page.h"
#include "page/sections.h"
#include "page/units.h"
#include "sundial/method_choice.h"

namespace sundial::command {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMostMethods = 16;  // of a request

struct Options {
  std::string scene, output, credit, baseline = "sm,texels=2048";
  std::vector<std::string> methods;
  unsigned repetitions = 5;
  ViewOptions view;
};

v1::RenderRequest makeRequest(const Options& options) {
  v1::RenderRequest request;
  options.view.apply(request);
  for (const std::string& method : options.methods)
    *request.add_methods() = orRefuse(client::parseMethodChoice(method));
  if (options.methods.size() > kMostMethods)
    throw refusal(fmt::format("--method: {} methods; compare at most {} at once", options.methods.size(),
                              kMostMethods));
  *request.mutable_baseline() = orRefuse(client::parseMethodChoice(options.baseline));
  request.set_repetitions(options.repetitions);
  request.set_measures(true);
  if (!options.output.empty())
    for (const v1::Aov aov : {v1::COLOUR, v1::VISIBILITY, v1::REFERENCE, v1::POSITION, v1::VIEW, v1::CLASS})
      request.add_images(aov);
  return request;
}

std::string quartiles(const google::protobuf::RepeatedField<double>& values) {
  return values.size() == 2 ? fmt::format("[{:.2f}, {:.2f}]", values[0], values[1]) : "";
}

void printTable(const v1::Report& report, const std::vector<std::string>& labels) {
  std::size_t width = 6;
  for (const std::string& label : labels) width = std::max(width, label.size());
  fmt::print("{}, {} x {}; {}; ratios to {}\n\n", report.scene(), report.size(0), report.size(1),
             report.device(), report.baseline());
  fmt::print("{:<{}}  {:>9} {:>9} {:>12} {:>9} {:>9} {:>9}  {:<19} {:>9} {:>9}\n", "method", width, "wrong",
             "false lit", "false shadow", "interior", "edge p95", "frame", "ratio", "store", "total");
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const v1::Result& result = report.results(static_cast<int>(i));
    const v1::Measures& measures = result.measures();
    fmt::print("{:<{}}  {:>9} {:>9} {:>12} {:>9} {:>9} {:>9}  {:<19} {:>9} {:>9}\n", labels[i], width,
               page::percent(page::wrongShare(result)), page::percent(measures.false_lit()),
               page::percent(measures.false_shadow()), page::percent(measures.interior_error()),
               fmt::format("{:.2f} px", measures.edge_error_px().p95()),
               page::milliseconds(result.frame_ms()) + " ms",
               fmt::format("{:.2f} {}", result.ratio_to_baseline(), quartiles(result.ratio_quartiles())),
               page::bytes(measures.store_bytes()), page::bytes(measures.total_bytes()));
  }
  fmt::print("\nmedian ms of each pass\n");
  for (std::size_t i = 0; i < labels.size(); ++i) {
    std::string passes;
    for (const v1::Pass& pass : report.results(static_cast<int>(i)).passes())
      passes +=
          fmt::format("{}{} {}", passes.empty() ? "" : ", ", pass.name(), page::milliseconds(pass.gpu_ms()));
    fmt::print("{:<{}}  {}\n", labels[i], width, passes);
  }
}

void compare(Session& session, const Options& options) {
  // Refuse what can be refused here.
  v1::RenderRequest request = makeRequest(options);
  if (!options.output.empty()) makeFolder(options.output);

  request.set_scene(session.sceneReference(options.scene));
  const client::Rendering rendering = session.render(request);
  const v1::Report report =
      makeReport(options.scene, request, rendering, session.answer(session.client().serverInfo()));
  std::vector<std::string> labels;
  for (const v1::MethodChoice& method : request.methods()) labels.push_back(client::methodLabel(method));

  if (!options.output.empty())
    image::writeFiles(
        page::comparisonFiles(options.output, {report, rendering, labels, options.credit}, toJson(report)));
  if (session.options().json) return printJson(report);
  printTable(report, labels);
  if (!options.output.empty() && !session.options().quiet)
    fmt::print("\n{}\n", (fs::path(options.output) / "index.html").string());
}

}  // namespace

void addCompare(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("compare", "Hold methods against ray-traced shadows: error, time, memory");
  command->footer(
      "Example:\n  sundial compare builtin:atrium --method sm,texels=1024 --method dv --method ray-traced -o "
      "out");
  const auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->scene, kSceneHelp)->required();
  command->add_option("--method", options->methods, "one of those compared; repeat it for each")
      ->type_name(kMethodSyntax)
      ->allow_extra_args(false)
      ->required();
  command->add_option("--baseline", options->baseline, "whose time is 1 [sm,texels=2048]")
      ->type_name(kMethodSyntax);
  command->add_option("--repetitions", options->repetitions, "timed frames of each method, 1 to 100 [5]")
      ->type_name("N")
      ->check(CLI::Range(1, 100));
  command->add_option("-o,--output", options->output, "folder for pictures, report.json and index.html")
      ->type_name("DIR");
  command->add_option("--credit", options->credit, "who made the scene: a line under the page's pictures")
      ->type_name("TEXT");
  options->view.addTo(*command);
  command->callback(
      [&action, options] { action = [options](Session& session) { compare(session, *options); }; });
}

}  // namespace sundial::command
