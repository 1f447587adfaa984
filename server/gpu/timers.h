// Device timestamps and pipeline statistics around passes.
#pragma once

#include <array>

#include "gpu/device.h"

namespace sundial {

// Counts of one pass; they repeat exactly (fragments on lavapipe count in blocks of 4 by 4, before depth).
struct PassCounts {
  std::uint64_t vertices = 0;     // vertex shader invocations
  std::uint64_t primitives = 0;   // assembled
  std::uint64_t fragments = 0;    // fragment shader invocations
  std::uint64_t invocations = 0;  // of compute shaders
};

class PassTimers {
 public:
  PassTimers(const Device&, std::uint32_t passes);

  // A pass may be begun and ended again: the last time counts.
  void begin(VkCommandBuffer, std::uint32_t pass) const;
  void end(VkCommandBuffer, std::uint32_t pass) const;

  // After the work is done.
  double milliseconds(std::uint32_t pass) const;
  PassCounts counts(std::uint32_t pass) const;

 private:
  VkDevice device_;
  double millisecondsPerTick_;
  QueryPool timestamps_;
  QueryPool statistics_;
};

}  // namespace sundial
