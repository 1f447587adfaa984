// A case's line of the results.
#pragma once

#include "sundial/rendering.h"
#include "sweep/cases.h"

namespace sundial::sweep {

// `rendering` is of the case's request, by its one method.
v1::SweepLine makeLine(const Case&, const client::Rendering&);
v1::SweepLine makeLine(const Case&, const client::Error&);

}  // namespace sundial::sweep
