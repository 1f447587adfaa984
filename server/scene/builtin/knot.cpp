// A trefoil of two perforated shells, one inside the other and twisted against it: thin, full of holes, every
// shadow edge short and curved. What [Lecocq 2014] measures with its "YeahRight" model.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "scene/builtin/builtin.h"
#include "scene/builtin/random.h"
#include "scene/builtin/shapes.h"

namespace sundial::builtin {

namespace {

constexpr std::array<Parameter, 1> kParameters{{{"along", 24, 600, 143, "holes along the knot"}}};

constexpr unsigned kRing = 16;    // corners of a hole, and of the cell around it: a multiple of 4
constexpr double kThick = 0.012;  // of the sheets, metres
constexpr double kHeight = 1.5;   // of the knot's middle above the ground, metres

// A sheet along the knot, cut into cells of which each has a hole.
struct Shell {
  unsigned along, around;  // cells
  double radius;           // about the knot's line, metres, and by how much it swells and shrinks
  double swell;
  int twist;    // cells about the line on the way once along it: whole, so that the ends meet
  double hole;  // a hole's extent, share of its cell
};

// A place and its own axes across the knot's line; `turn` runs once along the line.
struct Section {
  glm::dvec3 centre, outward, side;
};

// The trefoil on a torus that lies flat: twice around its axis, three times around its ring.
Section sectionAt(double turn) {
  constexpr double kRadius = 1.55, kRingRadius = 0.72;
  const double axis = 2 * turn, ring = 3 * turn;
  const double r = kRadius + kRingRadius * cosTurns(ring);
  const glm::dvec3 radial(cosTurns(axis), 0, sinTurns(axis)), up(0, 1, 0);
  const glm::dvec3 centre = r * radial + glm::dvec3(0, kHeight + kRingRadius * sinTurns(ring), 0);
  const glm::dvec3 outward = cosTurns(ring) * radial + sinTurns(ring) * up;
  const glm::dvec3 around(-sinTurns(axis), 0, cosTurns(axis));
  const glm::dvec3 along =
      glm::normalize(2 * r * around + 3 * kRingRadius * (cosTurns(ring) * up - sinTurns(ring) * radial));
  return {centre, outward, glm::cross(along, outward)};
}

// A point of the shell: u in cells along the knot, v in cells around it, `height` above the sheet's middle.
glm::dvec3 pointOf(const Shell& shell, double u, double v, double height) {
  const double lap = u / shell.along;
  // Both ends of a lap must be one point: a lap later the section is the same, the cells have turned.
  const double turn = lap - std::floor(lap);
  const double cells = v + shell.twist * lap;
  const double angle = (cells - shell.around * std::floor(cells / shell.around)) / shell.around;
  const Section s = sectionAt(turn);
  const double radius = shell.radius + shell.swell * sinTurns(5 * turn) + height;
  return s.centre + radius * (cosTurns(angle) * s.outward + sinTurns(angle) * s.side);
}

// Corner `k` of a cell's outline, in the cell, or (scaled) of its hole, which is round.
glm::dvec2 outline(unsigned k) {
  const unsigned side = k * 4 / kRing;
  const double t = static_cast<double>(k % (kRing / 4)) * 4 / kRing;
  constexpr std::array<std::array<double, 4>, 4> kSides{
      {{0, 0, 1, 0}, {1, 0, 0, 1}, {1, 1, -1, 0}, {0, 1, 0, -1}}};
  const auto& [x, y, dx, dy] = kSides[side];
  return {x + t * dx, y + t * dy};
}

glm::dvec2 rim(unsigned k, double extent) {
  const glm::dvec2 p = outline(k) - 0.5;
  const double roundness = std::max(std::abs(p.x), std::abs(p.y)) / glm::length(p);
  return 0.5 + extent * p * roundness;
}

void addCell(Shape& shape, const Shell& shell, unsigned i, unsigned j) {
  for (unsigned k = 0; k < kRing; ++k) {
    const auto at = [&](const glm::dvec2& p, double height) {
      return pointOf(shell, i + p.x, j + p.y, height);
    };
    const glm::dvec2 a = outline(k), b = outline((k + 1) % kRing);
    const glm::dvec2 c = rim((k + 1) % kRing, shell.hole), d = rim(k, shell.hole);
    constexpr double kUp = kThick / 2;
    shape.quad(at(d, kUp), at(c, kUp), at(b, kUp), at(a, kUp));
    shape.quad(at(a, -kUp), at(b, -kUp), at(c, -kUp), at(d, -kUp));
    shape.quad(at(d, -kUp), at(c, -kUp), at(c, kUp), at(d, kUp));
  }
}

void makeKnot(SceneBuilder& builder, const Values& values) {
  const auto along = static_cast<unsigned>(values[0]);
  const Shell outer{along, 8, 0.42, 0.03, 4, 0.86};
  const Shell inner{along * 2 / 3, 5, 0.2, 0.02, -5, 0.8};

  std::vector<Primitive> shells;
  for (const auto& [shell, name, colour] : {std::tuple(outer, "copper", glm::vec3(0.62f, 0.27f, 0.13f)),
                                            {inner, "ivory", glm::vec3(0.75f, 0.7f, 0.55f)}}) {
    Shape shape;
    for (unsigned i = 0; i < shell.along; ++i)
      for (unsigned j = 0; j < shell.around; ++j) addCell(shape, shell, i, j);
    shells.push_back(std::move(shape).take(addColour(builder, name, colour)));
  }
  builder.addInstance("knot", builder.addMesh("knot", std::move(shells)), glm::dmat4(1));

  Shape ground;
  ground.surface(8, 8, [](double u, double v) { return glm::dvec3(12 * u - 6, 0, 6 - 12 * v); });
  std::vector<Primitive> plane;
  plane.push_back(std::move(ground).take(addColour(builder, "ground", {0.55f, 0.55f, 0.56f})));
  builder.addInstance("ground", builder.addMesh("ground", std::move(plane)), glm::dmat4(1));

  builder.addView(view("main", {5.2, 4.4, 5.6}, {0, 0.9, 0}, 42));
  builder.addView(view("close", {3.1, 2.9, 2.6}, {1.1, 1.4, 0.6}, 45));
  builder.addView(view("shadow", {-1.5, 2.2, -4.6}, {-1.7, 0, -1.7}, 50));
  builder.addView(view("top", {0.01, 11, 0}, {0, 0, 0}, 45));
  builder.addLight(sun("sun", 50, 0.14));
  builder.addLight(sun("low", 5, 0.06));
  builder.addLight(sun("noon", 80, 0.2));
  builder.addLight(spot("spot", {1.5, 6.5, 1.2}, {0, 0, 0}, 90));
  builder.addPath(
      {"orbit",
       {view("", {5.2, 4.4, 5.6}, {0, 0.9, 0}, 42).view, view("", {0, 4.4, 7.6}, {0, 0.9, 0}, 42).view,
        view("", {-5.2, 4.4, 5.6}, {0, 0.9, 0}, 42).view},
       120});
  builder.addPath({"drift",
                   {view("", {3.1, 2.9, 2.6}, {1.1, 1.4, 0.6}, 45).view,
                    view("", {2.8, 2.8, 2.9}, {0.9, 1.4, 0.7}, 45).view},
                   60});
  builder.addLightPath(
      {"day", {sun("", 62, 0.1).light, sun("", 50, 0.14).light, sun("", 34, 0.2).light}, 120});
}

}  // namespace

const Row kKnot{"knot", "a trefoil of two perforated shells: thin, twisted, full of holes", kParameters,
                makeKnot};

}  // namespace sundial::builtin
