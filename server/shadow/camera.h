// Views and lights as the shaders see them: FrameConstants, relative to the frame's origin.
#pragma once

#include <optional>
#include <string>

#include "scene/scene.h"
#include "shared/frame.h"

namespace sundial {

// The point of the world that GPU coordinates are relative to: the scene's centre, moved in steps of 1,024 m
// to where the camera is. Floats then resolve 0.1 mm near the camera wherever the scene lies, and a moving
// camera doesn't change the maps of methods that don't depend on it.
glm::dvec3 frameOrigin(const Scene&, const View&);

// Everything that follows from view, light and scene; what follows from the method is left zero.
shared::FrameConstants frameConstants(const Scene&, const View&, const Light&, glm::uvec2 imageSize,
                                      const glm::dvec3& origin);

// Why a view or light can't be rendered: names the field, the value and the range.
std::optional<std::string> whyInvalid(const View&);
std::optional<std::string> whyInvalid(const Light&);

}  // namespace sundial
