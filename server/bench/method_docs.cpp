// Writes the table of methods between the markers of a Markdown file, or checks that it is there as it
// should.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

#include "shadow/method.h"

namespace {

using namespace sundial;

constexpr std::string_view kBegin = "<!-- methods:begin -->\n", kEnd = "<!-- methods:end -->";
constexpr int kSkipped = 77;  // what ctest takes for a skipped test

std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string stagesOf(const MethodRow& row) {
  if (!row.stages) return "no map";
  std::string text;
  for (const std::string_view stage : stageNames())
    text += fmt::format("{}{}", text.empty() ? "" : " · ", stageChoice(*row.stages, stage));
  return text;
}

std::string rangeOf(const Parameter& p) {
  std::string text;
  const auto unit = p.unit.empty() || p.unit == "1" ? std::string() : fmt::format(" {}", p.unit);
  if (p.kind != Parameter::Kind::choice) text = fmt::format("{} to {}{}", p.min, p.max, unit);
  for (const std::string_view choice : p.choices)
    text += fmt::format("{}`{}`", text.empty() ? "" : ", ", choice);
  return text;
}

struct Shared {
  Parameter parameter;
  bool differs = false;  // in its default, from row to row
};

// Of all rows, each once.
std::vector<Shared> allParameters() {
  std::vector<Shared> all;
  for (const MethodRow& row : methodTable())
    for (const Parameter& p : parametersOf(row)) {
      const auto known =
          std::ranges::find_if(all, [&](const Shared& s) { return s.parameter.name == p.name; });
      if (known == all.end())
        all.push_back({p});
      else if (known->parameter.defaultValue != p.defaultValue)
        known->differs = true;
    }
  return all;
}

std::string table() {
  std::string heading;
  for (const std::string_view stage : stageNames())
    heading += fmt::format("{}{}", heading.empty() ? "" : " · ", stage);
  std::string out = fmt::format("| method | {} | what | source |\n| --- | --- | --- | --- |\n", heading);
  for (const MethodRow& row : methodTable())
    out +=
        fmt::format("| `{}` | {} | {} | {} |\n", row.name, stagesOf(row), cell(row.title), cell(row.source));
  out += "\n| parameter | default | range | what |\n| --- | --- | --- | --- |\n";
  for (const auto& [p, differs] : allParameters())
    out += fmt::format("| `{}` | {} | {} | {} |\n", p.name, differs ? "the row's" : p.defaultValue,
                       cell(rangeOf(p)), cell(p.description));
  return out;
}

int complain(const std::string& what, int status) {
  fmt::print(stderr, "method-docs: {}\n", what);
  return status;
}

int run(std::string_view mode, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return complain(fmt::format("there is no {}", path), kSkipped);
  std::ostringstream read;
  read << file.rdbuf();
  const std::string before = read.str();

  const auto begin = before.find(kBegin);
  const auto end = before.find(kEnd, begin);
  if (begin == std::string::npos || end == std::string::npos)
    return complain(fmt::format("{} lacks the line {}or {}", path, kBegin, kEnd), 1);
  const std::string after = before.substr(0, begin + kBegin.size()) + table() + before.substr(end);
  if (after == before) return 0;
  if (mode == "--check")
    return complain(
        fmt::format("{} isn't the table of the program: build the target update-method-docs", path), 1);
  std::ofstream out(path, std::ios::binary);
  out << after;
  return out.flush() ? 0 : complain(fmt::format("can't write {}", path), 1);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view mode = argc == 3 ? argv[1] : "";
  if (mode != "--check" && mode != "--write") return complain("give --check FILE or --write FILE", 2);
  return run(mode, argv[2]);
}
