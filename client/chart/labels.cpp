#include <fmt/format.h>

#include <set>

#include "chart/results.h"

namespace sundial::chart {
namespace {

// "2048x2048" as users write it: "2048".
std::string brief(const std::string& value) {
  const auto cross = value.find('x');
  const bool square = cross != std::string::npos && value.substr(0, cross) == value.substr(cross + 1);
  return square ? value.substr(0, cross) : value;
}

}  // namespace

// A parameter that some cases of a method don't have differs too; but those of failed cases are only what was
// asked for.
void labelCases(std::vector<Case>& cases) {
  std::map<std::string, std::map<std::string, std::set<std::string>>> values;  // by method and parameter
  for (const Case& one : cases)
    for (const auto& [key, value] : one.parameters) values[one.method][key].insert(value);
  for (const Case& one : cases)
    for (auto& [key, seen] : values[one.method])
      if (!one.failed && !one.parameters.contains(key)) seen.insert("");
  for (Case& one : cases) {
    one.label = one.method;
    for (const auto& [key, value] : one.parameters)
      if (values[one.method][key].size() > 1) one.label += fmt::format(",{}={}", key, brief(value));
  }
}

}  // namespace sundial::chart
