// The table of built-in scenes, and "name?key=value&..." to one of them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>

#include "scene/builtin/builtin.h"
#include "scene/builtin/random.h"
#include "scene/load.h"
#include "scene/quoted_name.h"

namespace sundial {

namespace builtin {

namespace {

constexpr std::array<const Row*, 8> kRows{&kAtrium,  &kObservatory, &kConference, &kTrees,
                                          &kVillage, &kCity,        &kKnot,       &kGrid};

std::string described(const Row& row) {
  std::vector<std::string> ranges;
  for (const Parameter& p : row.parameters)
    ranges.push_back(fmt::format("{} {} to {}", p.name, p.low, p.high));
  return ranges.empty() ? "none" : fmt::format("{}", fmt::join(ranges, ", "));
}

Result<Values> parseValues(const Row& row, std::string_view query) {
  Values values;
  for (const Parameter& p : row.parameters) values.push_back(p.fallback);
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string_view pair = query.substr(0, end);
    query = end == std::string_view::npos ? std::string_view{} : query.substr(end + 1);
    const std::size_t equals = pair.find('=');
    const std::string_view key = pair.substr(0, equals);
    const std::string_view text =
        equals == std::string_view::npos ? std::string_view{} : pair.substr(equals + 1);

    std::size_t which = 0;
    while (which < row.parameters.size() && row.parameters[which].name != key) ++which;
    if (which == row.parameters.size())
      return invalid(fmt::format("builtin:{} has no parameter {}; it has: {}", row.name, quotedName(key),
                                 described(row)));
    const Parameter& parameter = row.parameters[which];
    std::uint64_t value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || rest != text.data() + text.size() || value < parameter.low ||
        value > parameter.high)
      return invalid(fmt::format("builtin:{}: {} is {}, but must be an integer, {} to {} ({})", row.name, key,
                                 quotedName(text), parameter.low, parameter.high, parameter.description));
    values[which] = value;
  }
  return values;
}

}  // namespace

std::uint32_t addColour(SceneBuilder& builder, std::string name, const glm::vec3& linear, bool doubleSided) {
  return builder.addMaterial({.name = std::move(name),
                              .gpu = {.baseColour = glm::vec4(linear, 1),
                                      .alphaCutoff = 0,
                                      .texture = shared::kNoTexture,
                                      .wrapU = shared::kWrapRepeat,
                                      .wrapV = shared::kWrapRepeat},
                              .masked = false,
                              .doubleSided = doubleSided});
}

NamedLight sun(std::string name, double elevationDegrees, double azimuthTurns) {
  const double elevation = elevationDegrees / 360;
  Light light;
  light.kind = LightKind::directional;
  light.direction =
      glm::normalize(-glm::dvec3(cosTurns(elevation) * cosTurns(azimuthTurns), sinTurns(elevation),
                                 cosTurns(elevation) * sinTurns(azimuthTurns)));
  return {std::move(name), light};
}

NamedLight spot(std::string name, const glm::dvec3& from, const glm::dvec3& to, double coneDegrees) {
  Light light;
  light.kind = LightKind::spot;
  light.position = from;
  light.direction = glm::normalize(to - from);
  light.coneDegrees = coneDegrees;
  return {std::move(name), light};
}

NamedView view(std::string name, const glm::dvec3& eye, const glm::dvec3& target, double fovDegrees) {
  return {std::move(name),
          {.eye = eye, .target = target, .up = glm::dvec3(0, 1, 0), .verticalFovDegrees = fovDegrees}};
}

}  // namespace builtin

Result<Scene> makeBuiltin(std::string_view reference) {
  const std::size_t question = reference.find('?');
  const std::string_view name = reference.substr(0, question);
  for (const builtin::Row* row : builtin::kRows) {
    if (row->name != name) continue;
    const Result<builtin::Values> values = builtin::parseValues(
        *row, question == std::string_view::npos ? std::string_view{} : reference.substr(question + 1));
    if (!values) return std::unexpected(values.error());
    SceneBuilder builder{std::string(reference)};
    row->make(builder, *values);
    return std::move(builder).finish();
  }
  std::vector<std::string_view> names;
  for (const builtin::Row* row : builtin::kRows) names.push_back(row->name);
  return fail(ErrorCode::notFound, fmt::format("there is no built-in scene {}; there are: {}",
                                               quotedName(name), fmt::join(names, ", ")));
}

std::vector<BuiltinInfo> builtinScenes() {
  std::vector<BuiltinInfo> infos;
  for (const builtin::Row* row : builtin::kRows) infos.push_back({row->name, row->description});
  return infos;
}

}  // namespace sundial
