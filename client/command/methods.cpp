// sundial methods: the table, or one row with its parameters.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "command/command.h"
#include "command/json.h"

namespace sundial::command {
namespace {

// In the order of execution (DESIGN section 1); the map of the contract has none.
constexpr const char* kStages[] = {"volume", "partition", "warp", "focus", "resolution", "storage", "lookup"};

std::string stagesOf(const v1::Method& method) {
  std::string text;
  for (const char* stage : kStages)
    if (const auto found = method.stages().find(stage); found != method.stages().end())
      text += (text.empty() ? "" : " / ") + found->second;
  return text.empty() ? "no map" : text;
}

std::string rangeOf(const v1::Parameter& parameter) {
  if (!parameter.choices().empty()) return fmt::format("{}", fmt::join(parameter.choices(), " | "));
  const std::string unit = parameter.unit().empty() || parameter.unit() == "1" ? "" : " " + parameter.unit();
  return fmt::format("{} to {}{}", parameter.min(), parameter.max(), unit);
}

void printTable(const v1::ListMethodsResponse& table) {
  std::size_t width = 0;
  for (const v1::Method& method : table.methods()) width = std::max(width, method.name().size());
  for (const v1::Method& method : table.methods())
    fmt::print("{:<{}}  {}\n{:<{}}  {}\n", method.name(), width, method.title(), "", width, stagesOf(method));
}

void printRow(const v1::Method& method) {
  fmt::print("{}: {}\n  source: {}\n", method.name(), method.title(), method.source());
  for (const char* stage : kStages)
    if (const auto found = method.stages().find(stage); found != method.stages().end())
      fmt::print("  {:<10} {}\n", stage, found->second);
  if (!method.parameters().empty()) fmt::print("  parameters:\n");
  for (const v1::Parameter& parameter : method.parameters())
    fmt::print("    {}={}  ({}) {}\n", parameter.name(), parameter.default_value(), rangeOf(parameter),
               parameter.description());
}

void show(Session& session, const std::string& name) {
  const auto table = session.answer(session.client().listMethods());
  if (name.empty()) return session.options().json ? printJson(table) : printTable(table);
  const auto row = std::ranges::find(table.methods(), name, &v1::Method::name);
  if (row == table.methods().end()) {
    std::vector<std::string> names;
    for (const v1::Method& method : table.methods()) names.push_back(method.name());
    throw failure(fmt::format("there is no method '{}'; there are {}", name, fmt::join(names, ", ")));
  }
  session.options().json ? printJson(*row) : printRow(*row);
}

}  // namespace

void addMethods(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("methods", "Show the table of methods, or one row with its parameters");
  command->footer("Example:\n  sundial methods sm");
  const auto name = std::make_shared<std::string>();
  command->add_option("NAME", *name, "a row of the table");
  command->callback([&action, name] { action = [name](Session& session) { show(session, *name); }; });
}

}  // namespace sundial::command
