// What stops work between passes: somebody who no longer wants it, or a deadline.
#pragma once

#include <chrono>
#include <optional>
#include <stop_token>

#include "result.h"

namespace sundial {

struct Interrupt {
  std::stop_token stop;
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  std::optional<Error> raised() const;  // cancelled or deadlineExceeded
};

}  // namespace sundial
