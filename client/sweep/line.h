// A case's line of the results.
#pragma once

#include "sundial/rendering.h"
#include "sundial/stability.h"
#include "sweep/cases.h"

namespace sundial::sweep {

// `rendering` is of the case's request, by its one method; `along`, where something moves, of the run along
// the path.
v1::SweepLine makeLine(const Case&, const client::Rendering&, const std::optional<client::Stability>& along);
v1::SweepLine makeLine(const Case&, const client::Error&);

}  // namespace sundial::sweep
