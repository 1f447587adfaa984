#include "measure/distinct_texels.h"

#include <algorithm>
#include <bit>

#include "shared/plan.h"

namespace sundial {

namespace {
constexpr std::uint64_t kFree = std::uint64_t{shared::kNoShadowView} << 32;  // no view has this index
constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15u;                  // of 2^64: Fibonacci hashing
}  // namespace

DistinctTexels::DistinctTexels(std::size_t most)
    : slots_(std::bit_ceil(std::max<std::size_t>(2 * most, 2)), kFree),
      shift_(64 - static_cast<unsigned>(std::countr_zero(slots_.size()))) {}

void DistinctTexels::add(std::uint32_t view, std::uint32_t texel) {
  const std::uint64_t key = std::uint64_t{view} << 32 | texel;
  std::size_t slot = key * kGoldenRatio >> shift_;
  while (slots_[slot] != key && slots_[slot] != kFree) slot = (slot + 1) & (slots_.size() - 1);
  if (slots_[slot] == key) return;
  slots_[slot] = key;
  ++count_;
}

}  // namespace sundial
