// What jobs give, for programs that print it.
#pragma once

#include <string>
#include <vector>

#include "bench/place.h"
#include "renderer.h"

namespace sundial::bench {

// Measured, and timed `runs` times against the first method (0: not timed).
RenderJob jobAt(const Sight&, glm::uvec2 size, const std::vector<std::string>& methods, unsigned runs);

// A result a method. Throws std::runtime_error.
std::vector<MethodResult> resultsOf(Renderer&, const RenderJob&);

double wrongPercent(const MethodResult&);  // of a measured one
// Throws std::runtime_error for a pass that the method doesn't have.
const PassTiming& passOf(const MethodResult&, std::string_view name);

}  // namespace sundial::bench
