#include "shadow/method.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

namespace sundial {

namespace {

using Kind = Parameter::Kind;

constexpr std::string_view kAuto = "auto";

// A whole text as a number; nothing if it isn't one.
template <class T>
std::optional<T> parse(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "2048" or "1024x512".
std::optional<std::pair<unsigned, unsigned>> parseSize(std::string_view text) {
  const std::size_t x = text.find('x');
  const auto width = parse<unsigned>(text.substr(0, x));
  const auto height = x == std::string_view::npos ? width : parse<unsigned>(text.substr(x + 1));
  if (!width || !height) return std::nullopt;
  return std::pair(*width, *height);
}

bool within(const Parameter& p, double value) { return value >= p.min && value <= p.max; }

// Why the value isn't one of the parameter's.
std::optional<std::string> whyWrong(const Parameter& p, std::string_view value) {
  const std::string range =
      fmt::format("[{}, {}]{}{}", p.min, p.max, p.unit == "1" ? "" : " ", p.unit == "1" ? "" : p.unit);
  const bool choice = std::ranges::find(p.choices, value) != p.choices.end();
  switch (p.kind) {
    case Kind::choice:
      if (!choice) return fmt::format("choose one of {}", fmt::join(p.choices, ", "));
      break;
    case Kind::size: {
      const auto size = parseSize(value);
      if (!size || !within(p, size->first) || !within(p, size->second))
        return fmt::format("give a side, or WIDTHxHEIGHT, each in {}", range);
      break;
    }
    case Kind::integer: {
      const auto number = parse<int>(value);
      if (!number || !within(p, *number)) return fmt::format("give a whole number in {}", range);
      break;
    }
    case Kind::number: {
      if (choice) break;
      const auto number = parse<double>(value);
      if (!number || !within(p, *number))
        return fmt::format("give a number in {}{}", range,
                           p.choices.empty() ? "" : fmt::format(" or {}", fmt::join(p.choices, ", ")));
      break;
    }
  }
  return std::nullopt;
}

// The parameters of a row whose stages are settled: a parameter that no stage reads isn't there.
std::vector<Parameter> parametersFor(const MethodRow& row, const std::optional<Stages>& stages) {
  std::vector<Parameter> list;
  if (!stages) return list;
  list.push_back({.name = "texels",
                  .kind = Kind::size,
                  .unit = "texels",
                  .min = 16,
                  .max = 16384,
                  .defaultValue = "2048",
                  .description = "size of every map: a side, or WIDTHxHEIGHT"});
  list.push_back({.name = "bias_texels",
                  .kind = Kind::number,
                  .unit = "texels",
                  .min = 0,
                  .max = 100,
                  .defaultValue = "2",
                  .description = "how far a receiver moves towards the light, in texels of its map"});
  list.push_back({.name = "bias_world",
                  .kind = Kind::number,
                  .unit = "m",
                  .min = 0,
                  .max = 1e6,
                  .defaultValue = kAuto,
                  .description =
                      "the same in metres, added; auto: 2e-5 of the scene's diagonal, as near as the "
                      "reference looks",
                  .choices = {kAuto}});
  if (stages->lookup == Lookup::pcf)
    list.push_back({.name = "kernel",
                    .kind = Kind::integer,
                    .unit = "texels",
                    .min = 1,
                    .max = 15,
                    .defaultValue = "3",
                    .description = "side of the filter's box; with lookup=pcf"});
  for (const std::string_view stage : stageNames())
    if (stageChoices(stage).size() > 1)
      list.push_back({.name = stage,
                      .kind = Kind::choice,
                      .unit = "",
                      .defaultValue = stageChoice(*row.stages, stage),
                      .description = "another choice at this stage",
                      .choices = stageChoices(stage)});
  return list;
}

Method::Settings settingsFrom(const std::map<std::string, std::string>& parameters) {
  Method::Settings settings;
  const auto [width, height] = *parseSize(parameters.at("texels"));
  settings.width = width;
  settings.height = height;
  settings.biasTexels = *parse<double>(parameters.at("bias_texels"));
  settings.biasWorld = parse<double>(parameters.at("bias_world"));
  if (const auto kernel = parameters.find("kernel"); kernel != parameters.end())
    settings.kernel = *parse<unsigned>(kernel->second);
  return settings;
}

}  // namespace

std::vector<Parameter> parametersOf(const MethodRow& row) {
  // With every lookup's parameters: the description says which needs which.
  std::optional<Stages> stages = row.stages;
  if (stages) stages->lookup = Lookup::pcf;
  return parametersFor(row, stages);
}

Result<Method> chooseMethod(std::string_view name, const std::map<std::string, std::string>& wanted) {
  const auto row = std::ranges::find(methodTable(), name, &MethodRow::name);
  if (row == methodTable().end()) {
    std::vector<std::string_view> names;
    for (const MethodRow& r : methodTable()) names.push_back(r.name);
    return fail(ErrorCode::notFound,
                fmt::format("there is no method \"{}\": choose one of {}", name, fmt::join(names, ", ")));
  }
  Method method{.row = &*row, .stages = row->stages};
  for (const auto& [stage, choice] : wanted)
    if (method.stages) setStage(*method.stages, stage, choice);

  const std::vector<Parameter> parameters = parametersFor(*row, method.stages);
  for (const Parameter& p : parameters) method.parameters.emplace(p.name, p.defaultValue);
  for (const auto& [key, value] : wanted) {
    const auto parameter = std::ranges::find(parameters, key, &Parameter::name);
    if (parameter == parameters.end()) {
      const auto elsewhere = parametersOf(*row);
      if (const auto p = std::ranges::find(elsewhere, key, &Parameter::name); p != elsewhere.end())
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
    method.settings = settingsFrom(method.parameters);
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
