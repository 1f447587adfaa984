#include "scene/builtin/observatory_parts.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sundial::builtin {

namespace {

using glm::dvec2;
using glm::dvec3;

// In turns, of a sine in [0, 1]; the same on every machine.
double arcSine(double sine) {
  double low = 0, high = 0.25;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (sinTurns(middle) < sine ? low : high) = middle;
  }
  return low;
}

// From +x around to the slit's edge, where the dome is so far from its axis.
double slitTurns(const DomeSize& dome, double fromAxis) {
  return fromAxis > dome.slit ? arcSine(dome.slit / fromAxis) : 0.25;
}

// Azimuth from +x, elevation; both in turns.
dvec3 onDome(double radius, double azimuth, double elevation) {
  const double r = radius * cosTurns(elevation);
  return {r * cosTurns(azimuth), radius * sinTurns(elevation), r * sinTurns(azimuth)};
}

// A tube through points of a curve; its radius everywhere.
void addTube(Shape& shape, const std::vector<dvec3>& points, double radius, unsigned sides) {
  const std::vector<double> radii(points.size(), radius);
  shape.tube(points, radii, sides);
}

// Closed at both ends.
void addRod(Shape& shape, const dvec3& from, const dvec3& to, double radius, unsigned sides) {
  const dvec3 edge = 1e-3 * glm::normalize(to - from);
  const std::array<dvec3, 4> points{from, from + edge, to - edge, to};
  const std::array<double, 4> radii{0, radius, radius, 0};
  shape.tube(points, radii, sides);
}

}  // namespace

Shape domeShell(const DomeSize& dome) {
  constexpr double kTop = 0.2499;  // just before the pole, where a strip would have no width
  Shape shape;
  shape.surface(80, 24, [&](double u, double v) {
    const double elevation = kTop * v, gap = slitTurns(dome, dome.radius * cosTurns(elevation));
    return onDome(dome.radius, 1 - gap - u * (1 - 2 * gap), elevation);
  });
  return shape;
}

Shape domeRibs(const DomeSize& dome) {
  const double radius = dome.radius - 0.12;
  Shape shape;
  // Meridians: those that the slit interrupts end there.
  for (int i = 0; i < 20; ++i) {
    const double azimuth = (i + 0.5) / 20;
    std::vector<dvec3> points;
    for (int j = 0; j <= 22; ++j) {
      const double elevation = 0.244 * j / 22;
      const double gap = slitTurns(dome, dome.radius * cosTurns(elevation));
      if (azimuth < gap || azimuth > 1 - gap) break;
      points.push_back(onDome(radius, azimuth, elevation));
    }
    if (points.size() > 1) addTube(shape, points, 0.07, 4);
  }
  for (const double elevation : {0.035, 0.07, 0.105, 0.14, 0.175, 0.21}) {
    const double gap = slitTurns(dome, dome.radius * cosTurns(elevation));
    std::vector<dvec3> points;
    for (int j = 0; j <= 60; ++j)
      points.push_back(onDome(radius + 0.03, gap + (1 - 2 * gap) * j / 60, elevation));
    addTube(shape, points, 0.04, 4);
  }
  // The slit's frame, on both sides of it, and its shutters' rails.
  for (const double side : {-1.0, 1.0})
    for (const double offset : {0.0, 0.22}) {
      std::vector<dvec3> points;
      const double z = side * (dome.slit + offset);
      const double inPlane = std::sqrt(dome.radius * dome.radius - z * z) + (offset > 0 ? 0.1 : 0.0);
      for (int j = 0; j <= 40; ++j) {
        const double elevation = 0.26 * j / 40;
        points.emplace_back(inPlane * cosTurns(elevation), inPlane * sinTurns(elevation), z);
      }
      addTube(shape, points, offset > 0 ? 0.05 : 0.09, 6);
    }
  return shape;
}

Shape floorTile(double inner, double outer, int count) {
  constexpr double kJoint = 0.012, kBevel = 0.012;
  const double turn = 0.5 / count;
  const auto at = [&](double r, double side, double inset, double y) {
    const double s = sinTurns(turn), c = cosTurns(turn);
    return dvec3(side * (r * s - inset), y, r * c);
  };
  const double a = inner, b = outer - kJoint;
  const double inset = kJoint + kBevel;
  Shape shape;
  shape.quad(at(b - kBevel, -1, inset, 0), at(b - kBevel, 1, inset, 0), at(a + kBevel, 1, inset, 0),
             at(a + kBevel, -1, inset, 0));
  shape.quad(at(b, -1, kJoint, -kBevel), at(b, 1, kJoint, -kBevel), at(b - kBevel, 1, inset, 0),
             at(b - kBevel, -1, inset, 0));
  shape.quad(at(b, 1, kJoint, -kBevel), at(a, 1, kJoint, -kBevel), at(a + kBevel, 1, inset, 0),
             at(b - kBevel, 1, inset, 0));
  shape.quad(at(a, 1, kJoint, -kBevel), at(a, -1, kJoint, -kBevel), at(a + kBevel, -1, inset, 0),
             at(a + kBevel, 1, inset, 0));
  shape.quad(at(a, -1, kJoint, -kBevel), at(b, -1, kJoint, -kBevel), at(b - kBevel, -1, inset, 0),
             at(a + kBevel, -1, inset, 0));
  return shape;
}

Shape windingStairs(double height, int steps) {
  Shape shape;
  addRod(shape, {0, 0, 0}, {0, height + 1, 0}, 0.08, 12);
  std::vector<dvec3> handrail;
  for (int i = 0; i < steps; ++i) {
    const double y = height * (i + 1) / steps, turn = static_cast<double>(i) / steps;
    Shape tread;
    tread.box({-0.14, -0.04, 0.06}, {0.14, 0, 1.05});
    const std::array<dvec3, 2> post{dvec3(0, 0, 1.0), dvec3(0, 0.95, 1.0)};
    constexpr std::array<double, 2> kThin{0.014, 0.014};
    tread.tube(post, kThin, 4);
    shape.append(tread, translation({0, y, 0}) * turnedY(turn));
    handrail.emplace_back(sinTurns(turn), y + 0.95, cosTurns(turn));
  }
  addTube(shape, handrail, 0.025, 6);
  return shape;
}

Telescope makeTelescope() {
  Telescope t;
  constexpr std::array<dvec2, 7> kPier{
      {{1.1, 0}, {1.1, 0.25}, {0.85, 0.3}, {0.6, 0.8}, {0.5, 2.0}, {0.62, 2.15}, {0, 2.15}}};
  t.pier.lathe(kPier, 32);

  // The polar axis leans north (-x), the declination axis crosses it.
  const dvec3 head(0, 2.2, 0), polar = glm::normalize(dvec3(-0.62, 0.78, 0));
  const dvec3 top = head + 0.95 * polar;
  addRod(t.mount, head - 0.2 * polar, top, 0.22, 24);
  addRod(t.mount, top + dvec3(0, 0, -1.7), top + dvec3(0, 0, 0.85), 0.12, 20);
  constexpr std::array<dvec2, 4> kWheel{{{0, -0.06}, {0.55, -0.06}, {0.55, 0.06}, {0, 0.06}}};
  Shape wheel;
  wheel.lathe(kWheel, 48);
  glm::dmat4 lean(1);  // the wheel's axis is the polar one
  lean[1] = glm::dvec4(polar, 0);
  lean[0] = glm::dvec4(polar.y, -polar.x, 0, 0);
  lean[3] = glm::dvec4(head + 0.35 * polar, 1);
  t.mount.append(wheel, lean);
  for (const double z : {-1.25, -1.45, -1.65}) {
    addRod(t.mount, top + dvec3(0, 0, z - 0.08), top + dvec3(0, 0, z + 0.08), 0.3, 24);
  }

  // The tube points through the slit (+x, upwards).
  const dvec3 along = glm::normalize(dvec3(0.68, 0.73, 0)), middle = top + dvec3(0, 0, 0.95);
  const auto at = [&](double d) { return middle + d * along; };
  const std::array<dvec3, 8> spine{at(-2.3), at(-2.29), at(-1.6), at(-1.59),
                                   at(2.1),  at(2.11),  at(2.9),  at(2.91)};
  constexpr std::array<double, 8> kRadii{0.05, 0.16, 0.16, 0.27, 0.31, 0.38, 0.38, 0.3};
  t.tube.tube(spine, kRadii, 40);
  for (const double d : {-1.0, -0.25, 0.5, 1.25}) {
    const std::array<dvec3, 4> ring{at(d - 0.05), at(d - 0.04), at(d + 0.04), at(d + 0.05)};
    constexpr std::array<double, 4> kRing{0.28, 0.35, 0.35, 0.28};
    t.brass.tube(ring, kRing, 36);
  }
  // Finder, eyepiece and a rack wheel.
  const dvec3 beside(0, 0, 0.48);
  addRod(t.brass, at(-1.7) + beside, at(-0.4) + beside, 0.07, 16);
  addRod(t.brass, at(-2.55), at(-2.3), 0.06, 16);
  addRod(t.brass, at(-2.2) + dvec3(0, 0, -0.35), at(-2.2) + dvec3(0, 0, 0.35), 0.02, 8);
  return t;
}

Bookcase bookcase(double width, double height, int shelves, Random& random) {
  constexpr double kBoard = 0.03, kDepth = 0.32;
  const double half = width / 2;
  Bookcase made;
  for (const double x : {-half, half - kBoard}) made.wood.box({x, 0, -kDepth}, {x + kBoard, height, 0});
  made.wood.box({-half, 0, -0.02}, {half, height, 0});
  for (int i = 0; i <= shelves; ++i) {
    const double y = (height - kBoard) * i / shelves, room = height / shelves - kBoard;
    made.wood.box({-half, y, -kDepth}, {half, y + kBoard, 0});
    if (i == shelves) break;
    for (double x = -half + kBoard + 0.01; x < half - 0.1;) {
      const double thick = random.range(0.02, 0.055), tall = room * random.range(0.6, 0.93);
      const double back = -0.03, front = back - random.range(0.17, 0.25);
      made.books[random.below(3)].box({x, y + kBoard, front}, {x + thick, y + kBoard + tall, back});
      x += thick + (random.below(9) == 0 ? 0.12 : 0.003);
    }
  }
  return made;
}

Shape table(double width, double depth, double height) {
  const double x = width / 2, z = depth / 2;
  Shape shape;
  shape.box({-x, height - 0.04, -z}, {x, height, z});
  for (const double sx : {-1.0, 1.0})
    for (const double sz : {-1.0, 1.0}) {
      const dvec3 foot(sx * (x - 0.08), 0, sz * (z - 0.08));
      addRod(shape, foot, foot + dvec3(0, height - 0.04, 0), 0.035, 10);
    }
  for (const double side : {-1.0, 1.0})
    shape.box({-x + 0.1, height - 0.14, side * (z - 0.08) - 0.015},
              {x - 0.1, height - 0.04, side * (z - 0.08) + 0.015});
  return shape;
}

Shape lathedStool() {
  constexpr std::array<dvec2, 9> kProfile{{{0.22, 0},
                                           {0.22, 0.03},
                                           {0.05, 0.06},
                                           {0.04, 0.2},
                                           {0.06, 0.26},
                                           {0.035, 0.4},
                                           {0.19, 0.43},
                                           {0.19, 0.47},
                                           {0, 0.48}}};
  Shape shape;
  shape.lathe(kProfile, 20);
  return shape;
}

}  // namespace sundial::builtin
