// A scene's view and light by name; without a name its first, or else the default.
#pragma once

#include <optional>
#include <string>

#include "result.h"
#include "scene/scene.h"

namespace sundial {

// Errors: notFound, naming those that the scene has.
Result<View> chooseView(const Scene&, const std::optional<std::string>& name);
Result<Light> chooseLight(const Scene&, const std::optional<std::string>& name);

}  // namespace sundial
