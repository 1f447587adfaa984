#include "measure/distance_transform.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sundial {

namespace {

constexpr std::int32_t kFar = 1 << 21;  // more than any distance within a column

// Distances within each column. Of a function that is 0 or infinite the paper's envelope is two scans; they
// run row by row, so that memory is read in order.
std::vector<std::int32_t> columnDistances(glm::uvec2 size, std::span<const std::uint8_t> mask) {
  std::vector<std::int32_t> distance(mask.size());
  const std::size_t w = size.x, n = mask.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t above = i < w ? kFar : std::min(distance[i - w] + 1, kFar);
    distance[i] = mask[i] ? 0 : above;
  }
  for (std::size_t i = n; i-- > 0;)
    if (i + w < n) distance[i] = std::min(distance[i], distance[i + w] + 1);
  return distance;
}

// The lower envelope of the parabolas (x - apex)^2 + height over a row, from left to right.
class Envelope {
 public:
  explicit Envelope(std::size_t width) : parabolas_(width) {}

  void clear() { count_ = 0; }
  bool empty() const { return count_ == 0; }

  // Apexes come in ascending order. Heights are whole numbers, so that what is compared below is exact: where
  // two parabolas meet is a quotient that no rounding brings across a pixel.
  void add(double apex, double height) {
    double from = -std::numeric_limits<double>::infinity();
    for (; count_ > 0; --count_) {
      const Parabola& last = parabolas_[count_ - 1];
      from = (height + apex * apex - last.height - last.apex * last.apex) / (2 * (apex - last.apex));
      if (from > last.from) break;
      from = -std::numeric_limits<double>::infinity();
    }
    parabolas_[count_++] = {apex, height, from};
  }

  void squareRoots(std::span<float> row) const {
    std::size_t lowest = 0;
    for (std::size_t x = 0; x < row.size(); ++x) {
      const auto at = static_cast<double>(x);
      while (lowest + 1 < count_ && parabolas_[lowest + 1].from < at) ++lowest;
      const Parabola& p = parabolas_[lowest];
      row[x] = std::sqrt(static_cast<float>((at - p.apex) * (at - p.apex) + p.height));
    }
  }

 private:
  struct Parabola {
    double apex, height;
    double from;  // where it becomes the lowest
  };
  std::vector<Parabola> parabolas_;
  std::size_t count_ = 0;
};

}  // namespace

std::vector<float> distanceTransform(glm::uvec2 size, std::span<const std::uint8_t> mask) {
  const std::vector<std::int32_t> column = columnDistances(size, mask);
  std::vector<float> result(mask.size(), std::numeric_limits<float>::infinity());
  Envelope envelope(size.x);
  for (std::size_t first = 0; first < mask.size(); first += size.x) {
    envelope.clear();
    for (std::size_t x = 0; x < size.x; ++x) {
      const double height = column[first + x];
      if (height < kFar) envelope.add(static_cast<double>(x), height * height);
    }
    if (!envelope.empty()) envelope.squareRoots(std::span(result).subspan(first, size.x));
  }
  return result;
}

}  // namespace sundial
