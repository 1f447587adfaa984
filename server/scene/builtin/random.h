// Numbers that are the same on every machine: the standard library's distributions and sines are not.
#pragma once

#include <cstdint>

namespace sundial::builtin {

// PCG32 [O'Neill 2014, "PCG: A family of simple fast space-efficient statistically good algorithms"].
class Random {
 public:
  explicit Random(std::uint64_t seed) {
    next();
    state_ += seed;
    next();
  }
  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005u + 1442695040888963407u;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto turn = static_cast<std::uint32_t>(old >> 59);
    return shifted >> turn | shifted << ((32 - turn) & 31);
  }
  double unit() { return next() * 0x1p-32; }  // [0, 1)
  double range(double low, double high) { return low + (high - low) * unit(); }
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(unit() * count); }

 private:
  std::uint64_t state_ = 0;
};

// Of an angle in turns (1 is a full circle), to about 1e-15, by IEEE arithmetic alone.
double sinTurns(double turns);
double cosTurns(double turns);

}  // namespace sundial::builtin
