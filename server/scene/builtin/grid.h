// The scene `grid` in closed form: horizontal square plates over a ground plane. A horizontal plate's shadow
// on a horizontal plane is the plate moved (directional light) or scaled about the light's foot (spot,
// point), so that every shadow is a square along the axes, and its edges are known exactly.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/view.h"

namespace sundial::builtin {

// An axis-aligned rectangle in (x, z), world space, metres.
struct Rectangle {
  glm::dvec2 min{0}, max{0};
};

// Without thickness; seen, and casting, from both sides.
struct Plate {
  Rectangle area;
  double height = 0;  // y
};

// The plates of `grid?n=` near the origin (offset_km moves them), n x n of them, 1 m wide and 2 m apart, 0.5
// to 2.25 m high; all coordinates are exact in single precision. The ground is y = 0, a square of
// gridGroundHalf(n) each way around the origin.
std::vector<Plate> gridPlates(unsigned n);
double gridGroundHalf(unsigned n);

// The shadows that plates cast on the horizontal plane at `height`; plates at or below it cast none there.
// For a spot only the plates count, not its cone. A light must shine downwards, a spot or point lie above all
// plates.
class GridShadow {
 public:
  GridShadow(std::span<const Plate>, const Light&, double height = 0);

  // Whether light reaches a point (x, z) of the plane. On an edge either answer is right.
  bool lit(const glm::dvec2& xz) const;
  // Metres to the nearest place in the plane where lit() changes; infinity without plates.
  double edgeDistance(const glm::dvec2& xz) const;

 private:
  struct Segment {
    glm::dvec2 a, b;
  };
  void addEdge(const glm::dvec2& a, const glm::dvec2& b, std::size_t owner);

  std::vector<Rectangle> shadows_;
  std::vector<Segment> edges_;  // of the union of the shadows
};

}  // namespace sundial::builtin
