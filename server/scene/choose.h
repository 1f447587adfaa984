// A scene's view and light by name, or without a name its first, or else the default; its paths by name.
#pragma once

#include <optional>
#include <string>

#include "result.h"
#include "scene/scene.h"

namespace sundial {

// Errors: notFound, naming those that the scene has.
Result<View> chooseView(const Scene&, const std::optional<std::string>& name);
Result<Light> chooseLight(const Scene&, const std::optional<std::string>& name);

// A path by its name. Errors: notFound, naming those that there are.
Result<NamedPath> choosePath(const Scene&, const std::string& name);
Result<NamedLightPath> chooseLightPath(const Scene&, const std::string& name);

}  // namespace sundial
