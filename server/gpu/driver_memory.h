// The memory habits of a CPU driver.
#pragma once

namespace sundial {

// Has the process keep memory that it frees: lavapipe takes and frees megabytes a frame, and handing them
// back to the system each time cost 11 % of a frame in page faults. For the whole process; calling it again
// changes nothing.
void keepFreedMemory();

}  // namespace sundial
