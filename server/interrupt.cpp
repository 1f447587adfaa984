#include "interrupt.h"

namespace sundial {

std::optional<Error> Interrupt::raised() const {
  if (stop.stop_requested()) return Error{ErrorCode::cancelled, "the call was cancelled"};
  if (std::chrono::steady_clock::now() >= deadline)
    return Error{ErrorCode::deadlineExceeded,
                 "the deadline passed before the rendering was done: allow more time"};
  return std::nullopt;
}

}  // namespace sundial
