// sundial chart: the results of sweeps as a page, a table for spreadsheets, and figures for papers.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "chart/csv.h"
#include "chart/figures.h"
#include "chart/report.h"
#include "chart/results.h"
#include "command/command.h"
#include "command/failure.h"
#include "image/file.h"

namespace sundial::command {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> files, credits;
  std::string output, csv, svg;
};

chart::Results read(const std::vector<std::string>& files) {
  chart::Results results;
  try {
    results = chart::readResults({files.begin(), files.end()});
  } catch (const std::runtime_error& why) {
    throw refusal(why.what());
  }
  if (results.cases.empty())
    throw refusal(
        fmt::format("there is no result in {}; 'sundial sweep' writes them", fmt::join(files, ", ")));
  return results;
}

void checkOutput(const char* option, const std::string& file) {
  if (const auto why = image::whyUnwritable(file)) throw refusal(fmt::format("{}: {}", option, *why));
}

// The folder may be new.
void makeFolder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error) && !fs::create_directories(folder, error))
    throw refusal(fmt::format("--svg: can't make the folder {}: {}; choose another", folder.string(),
                              error ? error.message() : "a file is in its place"));
  checkOutput("--svg", folder / "x.svg");
}

void draw(const Session& session, const Options& options) {
  if (!options.output.empty()) checkOutput("-o", options.output);
  if (!options.csv.empty()) checkOutput("--csv", options.csv);
  chart::Results results = read(options.files);
  if (!options.svg.empty()) makeFolder(options.svg);

  std::vector<image::OutputFile> files;
  files.push_back({options.output, chart::reportPage(results, options.credits)});
  if (!options.csv.empty()) files.push_back({options.csv, chart::csvOf(results.cases)});
  if (!options.svg.empty())
    std::ranges::move(chart::figures(results.cases, options.svg), std::back_inserter(files));
  image::writeFiles(files);

  const auto failed =
      std::ranges::count_if(results.cases, [](const auto& one) { return one.failed.has_value(); });
  if (session.options().json) {
    nlohmann::ordered_json document{
        {"cases", results.cases.size()}, {"failed", failed}, {"remarks", results.remarks}};
    for (const image::OutputFile& file : files) document["files"].push_back(file.path.string());
    fmt::print("{}\n", document.dump(2));
    return;
  }
  if (session.options().quiet) return;
  for (const std::string& remark : results.remarks) fmt::print(stderr, "sundial: {}\n", remark);
  fmt::print("{} cases, {} of them failed\n", results.cases.size(), failed);
  for (const image::OutputFile& file : files) fmt::print("{}\n", file.path.string());
}

}  // namespace

void addChart(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("chart", "Draw the results of sweeps: error against time, memory and stability");
  command->footer("Example:\n  sundial chart results.jsonl -o report.html --csv results.csv");
  const auto options = std::make_shared<Options>();
  command
      ->add_option(
          "RESULTS", options->files,
          "what 'sundial sweep' wrote; several are merged, and of two lines of one\ncase the last counts")
      ->type_name("FILE...")
      ->required();
  command->add_option("-o,--output", options->output, "the page: one file, to be opened in a browser")
      ->type_name("FILE.html")
      ->required();
  command->add_option("--csv", options->csv, "a row a case, for spreadsheets")->type_name("FILE");
  command
      ->add_option("--svg", options->svg,
                   "folder of charts for papers: error against time and memory, stability, passes")
      ->type_name("DIR");
  command
      ->add_option("--credit", options->credits,
                   "who made a scene: a line at the page's end; repeat it for each")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command->callback(
      [&action, options] { action = [options](Session& session) { draw(session, *options); }; });
}

}  // namespace sundial::command
