#include "bench/place.h"

#include <optional>
#include <string_view>

#include "bench/program.h"
#include "scene/choose.h"
#include "scene/load.h"

namespace sundial::bench {

namespace {

constexpr std::string_view kBuiltin = "builtin:";

std::optional<std::string> named(const std::string& name) {
  return name.empty() ? std::nullopt : std::optional(name);
}

}  // namespace

Result<Scene> loadScene(const std::string& reference) {
  if (reference.starts_with(kBuiltin)) return makeBuiltin(reference.substr(kBuiltin.size()));
  const auto files = readSceneFiles(reference);
  if (!files) return std::unexpected(files.error());
  return parseGltf(*files);
}

Sight sightOf(const Place& place) {
  auto scene = std::make_shared<const Scene>(need(loadScene(place.scene)));
  const View view = need(chooseView(*scene, named(place.view)));
  const Light light = need(chooseLight(*scene, named(place.light)));
  return {std::move(scene), view, light};
}

std::string shortName(const std::string& reference) {
  return reference.substr(reference.find_last_of(":/") + 1);
}

}  // namespace sundial::bench
