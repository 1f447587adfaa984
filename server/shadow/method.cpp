#include "shadow/method.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "shadow/parameter_values.h"
#include "shadow/parameters.h"

namespace sundial {

std::vector<Parameter> parametersOf(const MethodRow& row) {
  std::vector<Parameter> all = parametersFor(row, row.stages);
  if (!row.stages) return all;
  for (const auto& [storage, lookup] : {std::pair(Storage::depth, Lookup::pcf),
                                        {Storage::linear, Lookup::pcf},
                                        {Storage::triangle, Lookup::spsm},
                                        {Storage::moments, Lookup::evsm}}) {
    Stages stages = *row.stages;
    stages.storage = storage;
    stages.lookup = lookup;
    if (whyImpossible(stages)) continue;
    for (const Parameter& p : parametersFor(row, stages))
      if (std::ranges::find(all, p.name, &Parameter::name) == all.end()) all.push_back(p);
  }
  return all;
}

Result<Method> chooseMethod(std::string_view name, const std::map<std::string, std::string>& wanted) {
  const auto row = std::ranges::find(methodTable(), name, &MethodRow::name);
  if (row == methodTable().end()) {
    std::vector<std::string_view> names;
    for (const MethodRow& r : methodTable()) names.push_back(r.name);
    return fail(ErrorCode::notFound,
                fmt::format("there is no method \"{}\": choose one of {}", name, fmt::join(names, ", ")));
  }
  Method method{.row = &*row, .wanted = wanted, .stages = row->stages};
  for (const auto& [stage, choice] : wanted)
    if (method.stages) setStage(*method.stages, stage, choice);

  const std::vector<Parameter> parameters = parametersFor(*row, method.stages);
  for (const Parameter& p : parameters) method.parameters.emplace(p.name, p.defaultValue);
  for (const auto& [key, value] : wanted) {
    const auto parameter = std::ranges::find(parameters, key, &Parameter::name);
    if (parameter == parameters.end()) {
      if (const auto p = knownParameter(key); p && method.stages)
        return invalid(
            fmt::format("method {}: no stage reads {}={} here ({})", name, key, value, p->description));
      std::vector<std::string_view> names;
      for (const Parameter& p : parameters) names.push_back(p.name);
      return invalid(names.empty() ? fmt::format("method {} has no parameters, so no {}", name, key)
                                   : fmt::format("method {} has no parameter {}: it has {}", name, key,
                                                 fmt::join(names, ", ")));
    }
    if (const auto why = whyWrong(*parameter, value))
      return invalid(fmt::format("method {}: {}={} can't be: {}", name, key, value, *why));
    method.parameters[key] = value;
  }
  if (method.stages) {
    if (const auto why = whyImpossible(*method.stages))
      return invalid(fmt::format("method {}: {}", name, *why));
    method.settings = settingsFrom(method.parameters, *method.stages);
    if (const auto why = whyInconsistent(*method.stages, method.settings))
      return invalid(fmt::format("method {}: {}", name, *why));
  }
  return method;
}

Result<Method> parseMethod(std::string_view text) {
  const std::size_t comma = text.find(',');
  std::map<std::string, std::string> parameters;
  for (std::size_t begin = comma; begin != std::string_view::npos;) {
    const std::size_t end = text.find(',', begin + 1);
    const std::string_view item =
        text.substr(begin + 1, end == std::string_view::npos ? end : end - begin - 1);
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos || equals == 0)
      return invalid(fmt::format("method \"{}\": \"{}\" is not key=value", text, item));
    if (!parameters.emplace(item.substr(0, equals), item.substr(equals + 1)).second)
      return invalid(fmt::format("method \"{}\": {} is given twice", text, item.substr(0, equals)));
    begin = end;
  }
  return chooseMethod(text.substr(0, comma), parameters);
}

std::string Method::label() const {
  std::string out(row->name);
  const std::vector<Parameter> known = parametersFor(*row, stages);
  for (const auto& [key, value] : parameters) {
    const auto parameter = std::ranges::find(known, key, &Parameter::name);
    if (parameter != known.end() && parameter->defaultValue != value)
      out += fmt::format(",{}={}", key, value);
  }
  return out;
}

}  // namespace sundial
