// Runs a frame's passes and says what they took.
#pragma once

#include "gpu/timers.h"
#include "interrupt.h"
#include "shadow/frame.h"
#include "work.h"

namespace sundial {

struct FrameTiming {
  double frameMs = 0;          // the clock around everything
  std::vector<double> passMs;  // in the order of the passes
  std::vector<std::vector<Work>> work;
};

// On a CPU driver, whose passes take milliseconds to seconds, each pass is submitted on its own, so that a
// cancelled call stops between two of them; a GPU gets everything up to the next pass on the host at once:
// its whole frame is shorter than one of those passes. Errors: cancelled, deadlineExceeded. Throws GpuError.
Result<FrameTiming> runFrame(const Device&, const std::vector<Pass>&, const Interrupt&);

}  // namespace sundial
