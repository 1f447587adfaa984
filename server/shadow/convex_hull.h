// Convex polygons of the plane: the hull of points, and the smallest rectangle around one.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace sundial {

// The corners of the points' hull, counter-clockwise, without repetitions and without points on its sides:
// none, one or two where the points have no area. By monotone chains [Andrew 1979].
std::vector<glm::dvec2> convexHull(std::span<const glm::dvec2> points);

// Whether a hull as convexHull() gives it holds the point, on its sides, too; one without area holds nothing.
bool holds(std::span<const glm::dvec2> hull, const glm::dvec2& point);

struct Rectangle {
  glm::dvec2 axis{1, 0};                // unit: the direction of its first side
  glm::dvec2 low{1e300}, high{-1e300};  // along the axis, and across it (the axis turned by 90 degrees)
  bool empty() const { return low.x > high.x; }
  double area() const { return (high.x - low.x) * (high.y - low.y); }
};

// Around the corners of a hull as convexHull() gives them, for a map of so many texels across and down: that
// whose texels' width and height have the least sum, because edges at any angle are wrong by that; of no
// larger area than the one that isn't turned, which it is where none is better. One of its sides lies on one
// of the hull's: four calipers turn around it once [Toussaint 1983].
Rectangle smallestRectangle(std::span<const glm::dvec2> corners, const glm::dvec2& texels = glm::dvec2(1));

}  // namespace sundial
