// One stability job: points chosen along a path, then for every method each of the path's frames.
#pragma once

#include "job.h"

namespace sundial {

std::optional<std::string> whyInvalid(const StabilityJob&, const Device&);

// Errors and exceptions as Renderer::runStability.
Result<void> runStabilityJob(const JobContext&, const StabilityJob&, const Interrupt&, StabilitySink&);

}  // namespace sundial
