// Counts the texels that the view samples read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sundial {

// A set of (view, texel) pairs that only grows: open addressing, linear probing, at most half full.
class DistinctTexels {
 public:
  // `most`: how many calls of add() may come.
  explicit DistinctTexels(std::size_t most);

  void add(std::uint32_t view, std::uint32_t texel);
  std::size_t count() const { return count_; }

 private:
  std::vector<std::uint64_t> slots_;
  unsigned shift_;
  std::size_t count_ = 0;
};

}  // namespace sundial
