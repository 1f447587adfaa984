#include "scene/builtin/conference_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sundial::builtin {

namespace {

using glm::dvec2;
using glm::dvec3;

void addTube(Shape& shape, const std::vector<dvec3>& points, double radius, unsigned sides) {
  const std::vector<double> radii(points.size(), radius);
  shape.tube(points, radii, sides);
}

// A cushion over a rectangle: thick in the middle, round at its rim. point(x, y) places its middle surface
// and says where its front lies.
template <class Surface>
void addCushion(Shape& shape, unsigned across, unsigned along, double thickness, Surface surface) {
  for (const double side : {1.0, -1.0})
    shape.surface(across, along, [&](double u, double v) {
      const double s = side > 0 ? u : 1 - u;
      const double rim = std::min(std::min(s, 1 - s), std::min(v, 1 - v));
      const double swell = std::min(1.0, 8 * rim);
      return surface(2 * s - 1, 2 * v - 1, side * 0.5 * thickness * swell * (2 - swell));
    });
}

}  // namespace

Chair officeChair() {
  Chair chair;
  for (int i = 0; i < 5; ++i) {
    const double turn = i / 5.0;
    Shape leg;
    addTube(leg, {{0, 0.12, 0.03}, {0, 0.1, 0.18}, {0, 0.075, 0.3}}, 0.022, 6);
    constexpr std::array<dvec2, 4> kWheel{{{0, -0.012}, {0.028, -0.012}, {0.028, 0.012}, {0, 0.012}}};
    Shape wheel;
    wheel.lathe(kWheel, 12);
    for (const double x : {-0.018, 0.018}) leg.append(wheel, translation({x, 0.028, 0.3}) * turnedZ(0.25));
    chair.metal.append(leg, turnedY(turn));
  }
  constexpr std::array<dvec2, 7> kLift{
      {{0.05, 0.09}, {0.05, 0.15}, {0.03, 0.15}, {0.03, 0.3}, {0.02, 0.3}, {0.02, 0.42}, {0.09, 0.43}}};
  chair.metal.lathe(kLift, 14);
  // Arms, and the bracket behind.
  for (const double x : {-0.29, 0.29})
    addTube(chair.metal,
            {{0.7 * x, 0.44, 0.02}, {x, 0.46, 0.03}, {x, 0.6, 0.06}, {x, 0.67, 0.02}, {x, 0.68, -0.22}},
            0.018, 6);
  addTube(chair.metal, {{0, 0.42, 0}, {0, 0.42, 0.2}, {0, 0.5, 0.27}, {0, 0.62, 0.29}}, 0.025, 6);

  addCushion(chair.cloth, 12, 12, 0.07, [](double x, double z, double height) {
    const double waterfall = z < -0.6 ? (z + 0.6) * (z + 0.6) * 0.12 : 0;
    return dvec3(-0.25 * x, 0.47 + 0.015 * x * x - waterfall + height, 0.24 * z);
  });
  // Upwards, so that its front looks along -z.
  addCushion(chair.cloth, 10, 16, 0.05, [](double x, double y, double height) {
    const double lumbar = 0.03 * (1 - y * y);
    const double lean = 0.05 * (y + 1);
    return dvec3(-0.23 * x * (1 - 0.12 * (y + 1)), 0.82 + 0.3 * y,
                 0.26 + lean - lumbar - 0.04 * x * x - height);
  });
  return chair;
}

LongTable longTable(double length, double width, double height) {
  LongTable made;
  const double straight = 0.5 * (length - width), radius = 0.5 * width;
  constexpr double kThick = 0.05, kSlot = 0.06;
  // Around the rim: the right end, then the left.
  const auto rim = [&](double turn) {
    const double x = sinTurns(turn) >= 0 ? straight : -straight;
    return dvec3(x + radius * sinTurns(turn), 0, radius * cosTurns(turn));
  };
  for (const double side : {1.0, -1.0}) {
    made.top.surface(64, 1, [&](double u, double v) {
      // Half of the rim, its other end the slot's edge.
      const double turn = side > 0 ? 0.25 - 0.5 * u : 0.75 - 0.5 * u;
      const dvec3 outside = rim(turn + 1e-9 * side);
      const double edge = std::clamp(outside.x, -straight, straight);
      const dvec3 inside(edge, 0, side * kSlot);
      return glm::mix(inside, outside, v) + dvec3(0, height, 0);
    });
  }
  made.top.surface(96, 3, [&](double u, double v) {
    constexpr std::array<dvec2, 4> kEdge{{{-0.03, -kThick}, {0, -0.03}, {0, -0.008}, {-0.008, 0}}};
    const dvec2 p = kEdge[static_cast<std::size_t>(std::lround(v * 3))];
    const double turn = u < 1 ? u : 0;
    const dvec3 outside = rim(turn);
    const dvec3 outwards(sinTurns(turn), 0, cosTurns(turn));
    return outside + p.x * outwards + dvec3(0, height + p.y, 0);
  });
  made.top.box({-straight, height - kThick, -radius + 0.03}, {straight, height - 0.01, radius - 0.03});
  for (const double x : {-straight, 0.0, straight}) {
    constexpr std::array<dvec2, 8> kFoot{{{0.45, 0},
                                          {0.45, 0.02},
                                          {0.2, 0.06},
                                          {0.12, 0.12},
                                          {0.1, 0.4},
                                          {0.14, 0.62},
                                          {0.3, 0.68},
                                          {0.3, 0.69}}};
    Shape foot;
    foot.lathe(kFoot, 36);
    made.feet.append(foot, translation({x, 0, 0}));
  }
  return made;
}

Shape blind(double width, double height, int slats) {
  constexpr double kDepth = 0.05;
  const double half = width / 2, pitch = (height - 0.06) / slats;
  Shape shape;
  shape.box({-half, -0.05, -0.03}, {half, 0, 0.03});
  for (int i = 0; i < slats; ++i) {
    const double y = -0.06 - pitch * (i + 0.5);
    shape.surface(1, 4, [&](double u, double v) {
      const double across = (v - 0.5) * kDepth;
      return dvec3(half * (2 * u - 1), y + 0.006 * (1 - 4 * (v - 0.5) * (v - 0.5)) - 0.45 * across, across);
    });
  }
  for (const double x : {-0.7 * half, 0.7 * half})
    addTube(shape, {{x, 0, 0.03}, {x, -height, 0.03}}, 0.002, 3);
  shape.box({-half, -height - 0.02, -0.02}, {half, -height, 0.02});
  return shape;
}

Shape laptop() {
  Shape shape;
  shape.box({-0.16, 0, -0.11}, {0.16, 0.014, 0.11});
  for (int row = 0; row < 5; ++row)
    for (int key = 0; key < 12; ++key) {
      const double x = -0.138 + 0.0232 * key, z = -0.085 + 0.02 * row;
      shape.box({x, 0.014, z}, {x + 0.02, 0.017, z + 0.016});
    }
  shape.quad({-0.16, 0.014, -0.11}, {0.16, 0.014, -0.11}, {0.16, 0.22, -0.17}, {-0.16, 0.22, -0.17});
  shape.quad({0.16, 0.014, -0.118}, {-0.16, 0.014, -0.118}, {-0.16, 0.22, -0.178}, {0.16, 0.22, -0.178});
  return shape;
}

Shape carafe() {
  constexpr std::array<dvec2, 12> kProfile{{{0, 0},
                                            {0.045, 0},
                                            {0.055, 0.02},
                                            {0.06, 0.08},
                                            {0.05, 0.14},
                                            {0.028, 0.18},
                                            {0.024, 0.22},
                                            {0.032, 0.25},
                                            {0.03, 0.25},
                                            {0.022, 0.22},
                                            {0.03, 0.16},
                                            {0, 0.15}}};
  Shape shape;
  shape.lathe(kProfile, 28);
  return shape;
}

Shape tumbler() {
  constexpr std::array<dvec2, 6> kProfile{
      {{0, 0}, {0.03, 0}, {0.036, 0.1}, {0.033, 0.1}, {0.028, 0.01}, {0, 0.01}}};
  Shape shape;
  shape.lathe(kProfile, 20);
  return shape;
}

Shape notepad() {
  Shape shape;
  shape.box({-0.105, 0, -0.15}, {0.105, 0.008, 0.15});
  addTube(shape, {{0.05, 0.013, -0.06}, {0.09, 0.013, 0.07}}, 0.005, 6);
  return shape;
}

Shape microphone() {
  constexpr std::array<dvec2, 4> kBase{{{0.06, 0}, {0.06, 0.015}, {0.02, 0.03}, {0, 0.03}}};
  Shape shape;
  shape.lathe(kBase, 20);
  std::vector<dvec3> neck;
  for (int i = 0; i <= 12; ++i) {
    const double t = i / 12.0;
    neck.emplace_back(0, 0.02 + 0.32 * t - 0.08 * t * t, 0.2 * t * t);
  }
  addTube(shape, neck, 0.005, 6);
  addTube(shape, {neck.back(), neck.back() + dvec3(0, 0.01, 0.05)}, 0.012, 8);
  return shape;
}

Coffer coffer(double side) {
  Coffer made;
  const double half = side / 2;
  // Four mitred profiles that climb inwards, in steps.
  constexpr std::array<dvec2, 9> kProfile{{{0.04, 0},
                                           {0.06, 0.02},
                                           {0.06, 0.08},
                                           {0.09, 0.11},
                                           {0.12, 0.11},
                                           {0.12, 0.18},
                                           {0.16, 0.22},
                                           {0.2, 0.23},
                                           {0.2, 0.3}}};
  for (int i = 0; i < 4; ++i) {
    Shape length;
    length.quad({-half, 0, -half}, {half, 0, -half}, {half - 0.04, 0, -half + 0.04},
                {-half + 0.04, 0, -half + 0.04});
    length.surface(1, kProfile.size() - 1, [&](double u, double v) {
      const dvec2 p = kProfile[static_cast<std::size_t>(std::lround(v * (kProfile.size() - 1)))];
      return dvec3((2 * u - 1) * (half - p.x), p.y, -half + p.x);
    });
    made.frame.append(length, turnedY(i / 4.0));
  }
  const double inner = half - 0.2;
  made.frame.quad({-inner, 0.3, -inner}, {inner, 0.3, -inner}, {inner, 0.3, inner}, {-inner, 0.3, inner});
  // A lamp: a ring of tubes under a shade.
  constexpr std::array<dvec2, 6> kShade{
      {{0, 0.12}, {0.2, 0.12}, {0.24, 0.15}, {0.24, 0.2}, {0.05, 0.24}, {0.05, 0.3}}};
  made.lamp.lathe(kShade, 24);
  std::vector<dvec3> ring;
  for (int i = 0; i <= 24; ++i) {
    const double turn = i < 24 ? i / 24.0 : 0;
    ring.emplace_back(0.27 * sinTurns(turn), 0.16, 0.27 * cosTurns(turn));
  }
  addTube(made.lamp, ring, 0.015, 6);
  return made;
}

Shape roofLight(double side) {
  const double half = side / 2;
  constexpr double kTop = 0.4, kThick = 0.06;
  Shape shape;
  for (const double sign : {-1.0, 1.0}) {
    const double rim = sign * (half - kThick / 2);
    shape.box({rim - kThick / 2, 0, -half}, {rim + kThick / 2, kTop, half});
    shape.box({-half, 0, rim - kThick / 2}, {half, kTop, rim + kThick / 2});
  }
  for (const double bar : {-0.5, 0.0, 0.5}) {
    const double at = bar * half;
    shape.box({at - 0.025, kTop - 0.1, -half}, {at + 0.025, kTop, half});
    shape.box({-half, kTop - 0.08, at - 0.02}, {half, kTop - 0.02, at + 0.02});
  }
  return shape;
}

}  // namespace sundial::builtin
