#include "shadow/convex_hull.h"

#include <algorithm>
#include <array>

namespace sundial {

namespace {

using glm::dvec2;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }
dvec2 turned(const dvec2& v) { return {-v.y, v.x}; }

// Adds a point to a chain that turns left, in which points that no longer do are left out.
void extend(std::vector<dvec2>& chain, std::size_t first, const dvec2& p) {
  while (chain.size() >= first + 2 &&
         cross(chain.back() - chain[chain.size() - 2], p - chain[chain.size() - 2]) <= 0)
    chain.pop_back();
  chain.push_back(p);
}

// Without corners that all but coincide with the one before: the directions of what lies between them are
// rounding.
std::vector<dvec2> withoutShortSides(std::span<const dvec2> hull) {
  dvec2 low = hull[0], high = hull[0];
  for (const dvec2& p : hull) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double least = 1e-9 * glm::length(high - low);
  std::vector<dvec2> kept;
  for (const dvec2& p : hull)
    if (kept.empty() || (glm::distance(p, kept.back()) > least && glm::distance(p, kept.front()) > least))
      kept.push_back(p);
  return kept;
}

// The points without most of those that lie within others: within the hull of the farthest ones in eight
// directions [Akl and Toussaint 1978].
std::vector<dvec2> withoutInnermost(std::span<const dvec2> points) {
  constexpr std::array<dvec2, 4> kDirections = {dvec2(1, 0), dvec2(1, 1), dvec2(0, 1), dvec2(-1, 1)};
  std::array<double, 4> least, most;
  least.fill(1e300);
  most.fill(-1e300);
  std::array<dvec2, 8> farthest{};
  for (const dvec2& p : points)
    for (std::size_t i = 0; i < 4; ++i) {
      const double along = glm::dot(kDirections[i], p);
      if (along > most[i]) most[i] = along, farthest[i] = p;
      if (along < least[i]) least[i] = along, farthest[4 + i] = p;
    }
  std::vector<dvec2> kept;
  const auto inner = [&](const dvec2& p) {
    for (std::size_t i = 0; i < 8; ++i)
      if (!(cross(farthest[(i + 1) % 8] - farthest[i], p - farthest[i]) >= 0)) return false;
    return true;
  };
  for (const dvec2& p : points)
    if (!inner(p)) kept.push_back(p);
  kept.insert(kept.end(), farthest.begin(), farthest.end());
  return kept;
}

Rectangle quarterTurned(const Rectangle& r) {
  return {turned(r.axis), {r.low.y, -r.high.x}, {r.high.y, -r.low.x}};
}

}  // namespace

std::vector<dvec2> convexHull(std::span<const dvec2> points) {
  if (points.empty()) return {};
  std::vector<dvec2> sorted = withoutInnermost(points);
  std::ranges::sort(sorted,
                    [](const dvec2& a, const dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  const auto repeated = std::ranges::unique(sorted);
  sorted.erase(repeated.begin(), repeated.end());
  if (sorted.size() < 3) return sorted;

  std::vector<dvec2> hull;
  for (const dvec2& p : sorted) extend(hull, 0, p);
  const std::size_t right = hull.size() - 1;
  for (std::size_t i = sorted.size() - 1; i-- > 0;) extend(hull, right, sorted[i]);
  hull.pop_back();  // the first one again
  return hull;
}

bool holds(std::span<const dvec2> hull, const dvec2& point) {
  if (hull.size() < 3) return false;
  // The triangle about the first corner in whose angle the point lies.
  const dvec2 from = point - hull[0];
  std::size_t right = 1, left = hull.size() - 1;
  if (cross(hull[right] - hull[0], from) < 0 || cross(hull[left] - hull[0], from) > 0) return false;
  while (left - right > 1) {
    const std::size_t middle = (right + left) / 2;
    (cross(hull[middle] - hull[0], from) >= 0 ? right : left) = middle;
  }
  return cross(hull[left] - hull[right], point - hull[right]) >= 0;
}

Rectangle smallestRectangle(std::span<const dvec2> corners, const dvec2& texels) {
  if (corners.empty()) return {};
  const std::vector<dvec2> hull = withoutShortSides(corners);
  const std::size_t n = hull.size();
  if (n == 1) return {{1, 0}, hull[0], hull[0]};

  Rectangle unturned;
  for (const dvec2& p : hull) {
    unturned.low = glm::min(unturned.low, p);
    unturned.high = glm::max(unturned.high, p);
  }
  Rectangle best = unturned;
  const auto texelSides = [&](const Rectangle& r) {
    const dvec2 texel = (r.high - r.low) / texels;
    return texel.x + texel.y;
  };
  const auto consider = [&](const Rectangle& r) {
    for (const Rectangle& turn : {r, quarterTurned(r)})
      if (texelSides(turn) < (1 - 1e-6) * texelSides(best) && r.area() <= unturned.area()) best = turn;
  };
  consider(unturned);
  std::size_t right = 0, top = 0, left = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const dvec2 u = glm::normalize(hull[(i + 1) % n] - hull[i]), v = turned(u);
    // Each caliper moves on while the next corner lies farther in its direction.
    const auto moveOn = [&](std::size_t& at, const dvec2& direction) {
      for (std::size_t steps = 0; steps < n; ++steps) {
        if (glm::dot(hull[(at + 1) % n] - hull[at], direction) <= 0) break;
        at = (at + 1) % n;
      }
    };
    if (i == 0) right = 1;
    moveOn(right, u);
    if (i == 0) top = right;
    moveOn(top, v);
    if (i == 0) left = top;
    moveOn(left, -u);
    consider({u,
              {glm::dot(hull[left], u), glm::dot(hull[i], v)},
              {glm::dot(hull[right], u), glm::dot(hull[top], v)}});
  }
  // All corners, those left out too.
  for (const dvec2& p : corners) {
    const dvec2 at(glm::dot(p, best.axis), glm::dot(p, turned(best.axis)));
    best.low = glm::min(best.low, at);
    best.high = glm::max(best.high, at);
  }
  return best;
}

}  // namespace sundial
