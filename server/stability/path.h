// Views and lights between key frames.
#pragma once

#include <span>
#include <vector>

#include "result.h"
#include "scene/view.h"

namespace sundial {

// `frames` views at evenly spaced times from the first key to the last, both included; one frame is the first
// key. Eye, target, up and field of view move along straight lines from key to key.
// Errors: invalidArgument where a view on the way can't be one, naming the keys around it.
Result<std::vector<View>> viewsAlong(std::span<const View> keys, unsigned frames);

// The same for lights: position, direction and cone. Directions turn evenly enough where keys are near each
// other. Errors: invalidArgument for keys of different kinds, and for directions that are opposite.
Result<std::vector<Light>> lightsAlong(std::span<const Light> keys, unsigned frames);

}  // namespace sundial
