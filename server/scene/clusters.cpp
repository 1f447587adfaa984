// A bounding volume hierarchy cut off at 128 triangles: top-down splits by the binned surface area heuristic
// [Wald 2007, "On fast construction of SAH-based bounding volume hierarchies"], whose cost counts clusters
// instead of triangles, so that full clusters are preferred. meshopt_buildMeshlets grows clusters along the
// surface instead and loses which triangle is which; scene/README.md compares the two.
#include "scene/clusters.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <limits>

#include "shared/scene.h"

namespace sundial {

namespace {

constexpr std::uint32_t kBins = 16;
constexpr std::size_t kParallelTriangles = 8192;

struct Box {
  glm::vec3 min{std::numeric_limits<float>::max()};
  glm::vec3 max{std::numeric_limits<float>::lowest()};

  void grow(const glm::vec3& lo, const glm::vec3& hi) {
    min = glm::min(min, lo);
    max = glm::max(max, hi);
  }
  // Double: the extent of finite floats can overflow a float.
  double halfArea() const {
    const glm::dvec3 d = glm::dvec3(max) - glm::dvec3(min);
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

struct Item {
  glm::vec3 min, max;
  std::uint32_t triangle;
  double centre(int axis) const { return 0.5 * (static_cast<double>(min[axis]) + max[axis]); }
};

struct Bin {
  Box box;
  std::uint32_t count = 0;
};

struct Split {
  int axis = -1;  // -1: no plane separates the centres
  std::uint32_t bin = 0;
  double cost = std::numeric_limits<double>::max();
};

// Where along one axis the centres fall.
struct Binning {
  double origin, scale;
  int axis;
  std::uint32_t operator()(const Item& item) const {
    return std::min(static_cast<std::uint32_t>((item.centre(axis) - origin) * scale), kBins - 1);
  }
};

double cost(const Box& box, std::uint32_t count) {
  return box.halfArea() * ((count + shared::kMaxClusterTriangles - 1) / shared::kMaxClusterTriangles);
}

void considerAxis(std::span<const Item> items, const Binning& binning, Split& best) {
  std::array<Bin, kBins> bins;
  for (const Item& item : items) {
    Bin& bin = bins[binning(item)];
    bin.box.grow(item.min, item.max);
    ++bin.count;
  }

  // Sweep from the right, then from the left.
  std::array<double, kBins> right{};
  Bin sum;
  for (std::uint32_t i = kBins - 1; i > 0; --i) {
    sum.box.grow(bins[i].box.min, bins[i].box.max);
    sum.count += bins[i].count;
    right[i] = sum.count ? cost(sum.box, sum.count) : -1;
  }
  sum = {};
  for (std::uint32_t i = 1; i < kBins; ++i) {
    sum.box.grow(bins[i - 1].box.min, bins[i - 1].box.max);
    sum.count += bins[i - 1].count;
    if (!sum.count || right[i] < 0) continue;
    const double total = cost(sum.box, sum.count) + right[i];
    if (total < best.cost) best = {binning.axis, i, total};
  }
}

// Reorders `items` and returns how many go to the left; 0 < result < items.size().
std::size_t split(std::span<Item> items) {
  glm::dvec3 lo(std::numeric_limits<double>::max()), hi(std::numeric_limits<double>::lowest());
  for (const Item& item : items) {
    const glm::dvec3 centre(item.centre(0), item.centre(1), item.centre(2));
    lo = glm::min(lo, centre);
    hi = glm::max(hi, centre);
  }
  Split best;
  std::array<Binning, 3> binnings;
  for (int axis = 0; axis < 3; ++axis) {
    binnings[axis] = {lo[axis], kBins / (hi[axis] - lo[axis]), axis};
    if (hi[axis] > lo[axis] && binnings[axis].scale < std::numeric_limits<double>::max())
      considerAxis(items, binnings[axis], best);
  }
  if (best.axis < 0) {  // All centres coincide.
    const std::size_t clusters =
        (items.size() + shared::kMaxClusterTriangles - 1) / shared::kMaxClusterTriangles;
    return clusters / 2 * shared::kMaxClusterTriangles;
  }
  const Binning& binning = binnings[best.axis];
  // Stable, so that a cluster's triangles keep the order of the source, which is often good for caches.
  const auto middle = std::stable_partition(items.begin(), items.end(),
                                            [&](const Item& item) { return binning(item) < best.bin; });
  return static_cast<std::size_t>(middle - items.begin());
}

// Marks the first item of each cluster.
void splitAll(std::span<Item> items, std::span<std::uint8_t> isFirst) {
  if (items.size() <= shared::kMaxClusterTriangles) {
    isFirst[0] = 1;
    return;
  }
  const std::size_t left = split(items);
  const auto goLeft = [&] { splitAll(items.first(left), isFirst.first(left)); };
  const auto goRight = [&] { splitAll(items.subspan(left), isFirst.subspan(left)); };
  if (items.size() < kParallelTriangles) {
    goLeft();
    goRight();
  } else {
    tbb::parallel_invoke(goLeft, goRight);
  }
}

}  // namespace

TriangleClusters clusterTriangles(std::span<const glm::vec3> positions,
                                  std::span<const std::uint32_t> indices) {
  TriangleClusters result;
  const std::size_t count = indices.size() / 3;
  if (count == 0) {
    result.first = {0};
    return result;
  }
  std::vector<Item> items(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 &a = positions[indices[3 * i]], &b = positions[indices[3 * i + 1]],
                    &c = positions[indices[3 * i + 2]];
    items[i] = {glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), static_cast<std::uint32_t>(i)};
  }
  std::vector<std::uint8_t> isFirst(count, 0);
  splitAll(items, isFirst);

  result.order.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (isFirst[i]) result.first.push_back(static_cast<std::uint32_t>(i));
    result.order.push_back(items[i].triangle);
  }
  result.first.push_back(static_cast<std::uint32_t>(count));
  return result;
}

}  // namespace sundial
