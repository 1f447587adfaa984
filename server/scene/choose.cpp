#include "scene/choose.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sundial {

namespace {

template <class Named>
Result<Named> find(const std::vector<Named>& all, const std::string& name, std::string_view what) {
  std::vector<std::string_view> names;
  for (const Named& one : all) {
    if (one.name == name) return one;
    names.push_back(one.name);
  }
  return fail(ErrorCode::notFound,
              fmt::format("the scene has no {} '{}': it has {}", what, name,
                          names.empty() ? "none with a name" : fmt::format("{}", fmt::join(names, ", "))));
}

}  // namespace

Result<View> chooseView(const Scene& scene, const std::optional<std::string>& name) {
  if (name) {
    const auto found = find(scene.views, *name, "view");
    return found ? Result<View>(found->view) : std::unexpected(found.error());
  }
  return scene.views.empty() ? defaultView(scene) : scene.views.front().view;
}

Result<Light> chooseLight(const Scene& scene, const std::optional<std::string>& name) {
  if (name) {
    const auto found = find(scene.lights, *name, "light");
    return found ? Result<Light>(found->light) : std::unexpected(found.error());
  }
  return scene.lights.empty() ? defaultLight(scene) : scene.lights.front().light;
}

Result<NamedPath> choosePath(const Scene& scene, const std::string& name) {
  return find(scene.paths, name, "path");
}

Result<NamedLightPath> chooseLightPath(const Scene& scene, const std::string& name) {
  return find(scene.lightPaths, name, "light path");
}

}  // namespace sundial
