// A method as a kind of light has it: which of them go together.
#pragma once

#include "scene/view.h"
#include "shadow/method.h"

namespace sundial {

// The method that answers in this light: around a point light partition=single becomes partition=cube.
// Refused, with the reason, where stages and light don't go together.
Result<Method> methodInLight(const Method&, LightKind);

}  // namespace sundial
