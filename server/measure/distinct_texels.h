// Counts the texels that the view samples read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shared/plan.h"

namespace sundial {

// A set of (view, texel) pairs that only grows: a bit each, in pages that come into being when first touched.
// Neighbouring samples read neighbouring texels, so this stays in the cache where hashing wouldn't.
class DistinctTexels {
 public:
  void add(std::uint32_t view, std::uint32_t texel);  // view < kMaxShadowViews
  std::size_t count() const { return count_; }

 private:
  static constexpr std::uint32_t kPageBits = 4096;
  using Page = std::array<std::uint64_t, kPageBits / 64>;

  std::array<std::vector<std::uint32_t>, shared::kMaxShadowViews>
      pageOf_;  // one more than the page's index; 0: none
  std::vector<Page> pages_;
  std::size_t count_ = 0;
};

}  // namespace sundial
