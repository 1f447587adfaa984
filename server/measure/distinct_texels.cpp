#include "measure/distinct_texels.h"

namespace sundial {

void DistinctTexels::add(std::uint32_t view, std::uint32_t texel) {
  auto& pageOf = pageOf_[view];
  const std::uint32_t place = texel / kPageBits;
  if (place >= pageOf.size()) pageOf.resize(place + 1, 0);
  if (pageOf[place] == 0) {
    pages_.emplace_back();
    pageOf[place] = static_cast<std::uint32_t>(pages_.size());
  }
  std::uint64_t& word = pages_[pageOf[place] - 1][texel % kPageBits / 64];
  const std::uint64_t bit = std::uint64_t{1} << texel % 64;
  count_ += (word & bit) == 0;
  word |= bit;
}

}  // namespace sundial
