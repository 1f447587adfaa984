#pragma once

#include <string>

#include "sweep/cases.h"

namespace sundial::sweep {

// What a case is, and nothing of how it is written or timed: SweepLine.case. Results that outlive a version
// hold these: what they are made of may never change.
std::string idOf(const Case&);

}  // namespace sundial::sweep
