#include "scene/builtin/facade.h"

#include <array>
#include <cmath>

namespace sundial::builtin {

namespace {

constexpr double kBar = 0.05;  // width and depth of a window's bars

// A strip in front of the plane z = `back`: its front and the two sides along its length.
void addBar(Shape& shape, const glm::dvec2& min, const glm::dvec2& max, double back) {
  const double front = back + kBar;
  shape.quad({min.x, min.y, front}, {max.x, min.y, front}, {max.x, max.y, front}, {min.x, max.y, front});
  if (max.y - min.y > max.x - min.x) {
    shape.quad({min.x, min.y, back}, {min.x, min.y, front}, {min.x, max.y, front}, {min.x, max.y, back});
    shape.quad({max.x, min.y, front}, {max.x, min.y, back}, {max.x, max.y, back}, {max.x, max.y, front});
  } else {
    shape.quad({min.x, max.y, front}, {max.x, max.y, front}, {max.x, max.y, back}, {min.x, max.y, back});
    shape.quad({min.x, min.y, back}, {max.x, min.y, back}, {max.x, min.y, front}, {min.x, min.y, front});
  }
}

// The wall around an opening, and the opening's four reveals.
void addOpening(Shape& shape, const Bay& bay, const glm::dvec2& lo, const glm::dvec2& hi, double recess) {
  const auto& [min, max] = bay;
  if (lo.y > min.y) shape.quad({min.x, min.y, 0}, {max.x, min.y, 0}, {hi.x, lo.y, 0}, {lo.x, lo.y, 0});
  shape.quad({max.x, min.y, 0}, {max.x, max.y, 0}, {hi.x, hi.y, 0}, {hi.x, lo.y, 0});
  shape.quad({max.x, max.y, 0}, {min.x, max.y, 0}, {lo.x, hi.y, 0}, {hi.x, hi.y, 0});
  shape.quad({min.x, max.y, 0}, {min.x, min.y, 0}, {lo.x, lo.y, 0}, {lo.x, hi.y, 0});
  const double in = -recess;
  shape.quad({lo.x, lo.y, 0}, {lo.x, lo.y, in}, {lo.x, hi.y, in}, {lo.x, hi.y, 0});
  shape.quad({hi.x, lo.y, in}, {hi.x, lo.y, 0}, {hi.x, hi.y, 0}, {hi.x, hi.y, in});
  shape.quad({lo.x, lo.y, 0}, {hi.x, lo.y, 0}, {hi.x, lo.y, in}, {lo.x, lo.y, in});
  shape.quad({lo.x, hi.y, in}, {hi.x, hi.y, in}, {hi.x, hi.y, 0}, {lo.x, hi.y, 0});
}

// One slope, from its lower edge (v = 0) to the ridge, seen from +z: tiles that overlap like scales.
void addSlope(Shape& shape, const GableRoof& roof, const glm::vec3& tiles, const glm::vec3& wood,
              Random& random) {
  constexpr double kThickness = 0.12;
  const double half = roof.length / 2 + roof.overhang, reach = roof.span / 2 + roof.overhang;
  const double fall = roof.rise / (roof.span / 2) * reach;
  const auto at = [&](double u, double v, double lift) {
    return glm::dvec3((2 * u - 1) * half, roof.rise - fall * (1 - v) + lift, reach * (1 - v));
  };
  const auto columns = static_cast<unsigned>(std::ceil(2 * half / roof.tile));
  const auto rows = static_cast<unsigned>(std::ceil(std::sqrt(reach * reach + fall * fall) / roof.tile));
  for (unsigned row = 0; row < rows; ++row)
    for (unsigned column = 0; column < columns; ++column) {
      const double u0 = static_cast<double>(column) / columns, u1 = (column + 1.0) / columns;
      const double v0 = static_cast<double>(row) / rows, v1 = (row + 1.0) / rows;
      const double lift = random.range(0.03, 0.075);
      shape.paint(tiles * static_cast<float>(random.range(0.8, 1.2)));
      shape.quad(at(u0, v0, lift), at(u1, v0, lift), at(u1, v1, 0), at(u0, v1, 0));
      shape.quad(at(u0, v0, 0), at(u1, v0, 0), at(u1, v0, lift), at(u0, v0, lift));
    }
  // Boards below and around.
  shape.paint(wood);
  const double down = -kThickness;
  shape.quad(at(1, 0, down), at(0, 0, down), at(0, 1, down), at(1, 1, down));
  shape.quad(at(0, 0, down), at(1, 0, down), at(1, 0, 0), at(0, 0, 0));
  shape.quad(at(1, 0, down), at(1, 1, down), at(1, 1, 0), at(1, 0, 0));
  shape.quad(at(0, 1, down), at(0, 0, down), at(0, 0, 0), at(0, 1, 0));
}

}  // namespace

void addWindow(Shape& shape, const Bay& bay, const Window& window, const WallPaints& paints) {
  const double middle = (bay.min.x + bay.max.x) / 2;
  const glm::dvec2 lo(middle - window.width / 2, bay.min.y + window.sill);
  const glm::dvec2 hi(middle + window.width / 2, lo.y + window.height);
  shape.paint(paints.wall);
  addOpening(shape, bay, lo, hi, window.recess);
  const double in = -window.recess;
  shape.paint(paints.glass);
  shape.quad({lo.x, lo.y, in}, {hi.x, lo.y, in}, {hi.x, hi.y, in}, {lo.x, hi.y, in});

  shape.paint(paints.trim);
  for (unsigned i = 1; i < window.across; ++i) {
    const double x = glm::mix(lo.x, hi.x, static_cast<double>(i) / window.across);
    addBar(shape, {x - kBar / 2, lo.y}, {x + kBar / 2, hi.y}, in);
  }
  for (unsigned i = 1; i < window.up; ++i) {
    const double y = glm::mix(lo.y, hi.y, static_cast<double>(i) / window.up);
    addBar(shape, {lo.x, y - kBar / 2}, {hi.x, y + kBar / 2}, in);
  }
  if (window.ledge > 0) shape.box({lo.x - 0.08, lo.y - 0.09, 0}, {hi.x + 0.08, lo.y, window.ledge});
  if (window.shutters > 0) {
    shape.box({lo.x - window.shutters, lo.y, 0}, {lo.x - 0.02, hi.y, 0.05});
    shape.box({hi.x + 0.02, lo.y, 0}, {hi.x + window.shutters, hi.y, 0.05});
  }
}

Shape wallOfWindows(const glm::dvec2& size, unsigned columns, unsigned rows, const Window& window,
                    const WallPaints& paints) {
  Shape shape;
  for (unsigned row = 0; row < rows; ++row)
    for (unsigned column = 0; column < columns; ++column)
      addWindow(shape,
                {{size.x * column / columns, size.y * row / rows},
                 {size.x * (column + 1) / columns, size.y * (row + 1) / rows}},
                window, paints);
  return shape;
}

Shape railing(double width, double height, unsigned bars) {
  constexpr double kThin = 0.02;
  Shape shape;
  const double half = width / 2;
  shape.box({-half, height - 0.05, -0.03}, {half, height, 0.03});
  shape.box({-half, 0.08, -kThin}, {half, 0.12, kThin});
  for (unsigned i = 0; i < bars; ++i) {
    const double x = -half + (i + 0.5) * width / bars;
    const std::array<glm::dvec3, 2> bar{glm::dvec3{x, 0, 0}, glm::dvec3{x, height - 0.05, 0}};
    constexpr std::array<double, 2> kRadii{kThin, kThin};
    shape.tube(bar, kRadii, 3);
  }
  return shape;
}

Shape gableRoof(const GableRoof& roof, const glm::vec3& tiles, const glm::vec3& wood, Random& random) {
  Shape shape;
  for (const double turn : {0.0, 0.5}) {
    Shape slope;
    addSlope(slope, roof, tiles, wood, random);
    shape.append(slope, turnedY(turn));
  }
  shape.paint(tiles * 0.8f);
  const double half = roof.length / 2 + roof.overhang;
  shape.box({-half, roof.rise - 0.05, -0.13}, {half, roof.rise + 0.09, 0.13});
  return shape;
}

}  // namespace sundial::builtin
