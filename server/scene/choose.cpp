#include "scene/choose.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sundial {

namespace {

template <class T, class Named>
Result<T> find(const std::vector<Named>& all, T Named::*member, const std::string& name,
               std::string_view what) {
  std::vector<std::string_view> names;
  for (const Named& one : all) {
    if (one.name == name) return one.*member;
    names.push_back(one.name);
  }
  return fail(ErrorCode::notFound,
              fmt::format("the scene has no {} '{}': it has {}", what, name,
                          names.empty() ? "none with a name" : fmt::format("{}", fmt::join(names, ", "))));
}

}  // namespace

Result<View> chooseView(const Scene& scene, const std::optional<std::string>& name) {
  if (name) return find(scene.views, &NamedView::view, *name, "view");
  return scene.views.empty() ? defaultView(scene) : scene.views.front().view;
}

Result<Light> chooseLight(const Scene& scene, const std::optional<std::string>& name) {
  if (name) return find(scene.lights, &NamedLight::light, *name, "light");
  return scene.lights.empty() ? defaultLight(scene) : scene.lights.front().light;
}

}  // namespace sundial
