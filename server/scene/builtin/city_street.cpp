#include "scene/builtin/city_street.h"

#include <array>

#include "scene/builtin/facade.h"

namespace sundial::builtin {

namespace {

constexpr glm::vec3 kIron{0.05f, 0.055f, 0.06f}, kSteel{0.4f, 0.41f, 0.42f}, kTyre{0.025f, 0.025f, 0.025f},
    kPane{0.04f, 0.06f, 0.08f}, kTimber{0.22f, 0.12f, 0.06f};

void addRod(Shape& shape, const glm::dvec3& from, const glm::dvec3& to, double radius, unsigned sides) {
  const std::array<glm::dvec3, 2> points{from, to};
  const std::array<double, 2> radii{radius, radius};
  shape.tube(points, radii, sides);
}

// An outline in (x, y), counter-clockwise from its front left foot, drawn from z = -half to half.
void addExtruded(Shape& shape, std::span<const glm::dvec2> outline, double half) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    shape.quad({a.x, a.y, half}, {a.x, a.y, -half}, {b.x, b.y, -half}, {b.x, b.y, half});
  }
}

void addWheels(Shape& shape, double base, double half, double radius) {
  constexpr std::array<glm::dvec2, 4> kProfile{{{0, -0.1}, {1, -0.1}, {1, 0.1}, {0, 0.1}}};
  std::array<glm::dvec2, 4> profile = kProfile;
  for (glm::dvec2& p : profile) p.x *= radius;
  Shape wheel;
  wheel.paint(kTyre);
  wheel.lathe(profile, 7);
  // The axle lies along z: y to z.
  glm::dmat4 lying(1);
  lying[1] = {0, 0, 1, 0};
  lying[2] = {0, -1, 0, 0};
  for (const double x : {-base / 2, base / 2})
    for (const double z : {-half, half}) shape.append(wheel, translation({x, radius, z}) * lying);
}

// Body and cabin, each a side view that is drawn out across; the cabin's sides lean in a little.
Shape vehicle(std::span<const glm::dvec2> body, std::span<const glm::dvec2> cabin, double half,
              const glm::vec3& paint) {
  Shape shape;
  shape.paint(paint);
  addExtruded(shape, body, half);
  // Sides of body and cabin: between the outline's first half and its second, which mirror in number.
  const auto sides = [&](std::span<const glm::dvec2> outline) {
    const std::size_t n = outline.size();
    for (std::size_t i = 0; i + 1 < n / 2; ++i) {
      const glm::dvec2 a = outline[i], b = outline[i + 1], c = outline[n - 2 - i], d = outline[n - 1 - i];
      shape.quad({a.x, a.y, half}, {b.x, b.y, half}, {c.x, c.y, half}, {d.x, d.y, half});
      shape.quad({b.x, b.y, -half}, {a.x, a.y, -half}, {d.x, d.y, -half}, {c.x, c.y, -half});
    }
  };
  sides(body);
  shape.paint(kPane);
  half -= 0.12;
  addExtruded(shape, cabin, half);
  sides(cabin);
  return shape;
}

}  // namespace

Shape streetLamp() {
  Shape shape;
  shape.paint(kIron);
  constexpr std::array<glm::dvec2, 6> kPost{
      {{0.2, 0}, {0.2, 0.5}, {0.12, 0.6}, {0.09, 1.2}, {0.06, 6.6}, {0, 6.9}}};
  shape.lathe(kPost, 7);
  constexpr std::array<glm::dvec3, 6> kArm{
      {{0, 6.3, 0}, {0, 6.8, 0.25}, {0, 7.05, 0.7}, {0, 7.05, 1.2}, {0, 6.9, 1.6}, {0, 6.75, 1.75}}};
  constexpr std::array<double, 6> kRadii{0.045, 0.04, 0.04, 0.035, 0.035, 0.03};
  shape.tube(kArm, kRadii, 4);
  constexpr std::array<glm::dvec2, 5> kShade{{{0.3, 0}, {0.26, 0.12}, {0.12, 0.24}, {0.05, 0.4}, {0, 0.42}}};
  Shape shade;
  shade.paint(kIron);
  shade.lathe(kShade, 9);
  shade.paint({0.8f, 0.75f, 0.6f});
  constexpr std::array<glm::dvec2, 2> kGlass{{{0, 0.02}, {0.28, 0.02}}};
  shade.lathe(kGlass, 9);
  shape.append(shade, translation({0, 6.4, 1.78}));
  return shape;
}

Shape trafficLight() {
  constexpr double kArm = 6;
  Shape shape;
  shape.paint(kIron);
  addRod(shape, {0, 0, 0}, {0, 5.9, 0}, 0.1, 8);
  addRod(shape, {0, 5.7, 0}, {0, 5.9, kArm}, 0.06, 6);
  for (const glm::dvec3& at :
       {glm::dvec3(0, 2.6, 0.25), glm::dvec3(0, 5.1, kArm - 0.3), glm::dvec3(0, 5.05, kArm - 2.8)}) {
    shape.paint(kIron);
    shape.box(at - glm::dvec3(0.14, 0, 0.16), at + glm::dvec3(0.1, 1, 0.16));
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 lens = at + glm::dvec3(0.1, 0.1 + 0.31 * i, 0);
      shape.paint(std::array<glm::vec3, 3>{
          {{0.05f, 0.5f, 0.2f}, {0.6f, 0.4f, 0.05f}, {0.6f, 0.05f, 0.03f}}}[static_cast<std::size_t>(i)]);
      shape.box(lens - glm::dvec3(0, 0, 0.09), lens + glm::dvec3(0.03, 0.18, 0.09));
      shape.paint(kIron);
      shape.box(lens + glm::dvec3(0, 0.2, -0.11), lens + glm::dvec3(0.2, 0.23, 0.11));
    }
  }
  return shape;
}

Shape bench() {
  Shape shape;
  shape.paint(kIron);
  for (const double x : {-0.75, 0.75}) {
    shape.box({x - 0.03, 0, -0.2}, {x + 0.03, 0.42, -0.14});
    shape.box({x - 0.03, 0, 0.16}, {x + 0.03, 0.42, 0.22});
    shape.box({x - 0.03, 0.4, -0.26}, {x + 0.03, 0.9, -0.21});
    shape.box({x - 0.03, 0.38, -0.22}, {x + 0.03, 0.42, 0.24});
  }
  shape.paint(kTimber);
  for (int i = 0; i < 5; ++i) shape.box({-0.95, 0.42, -0.2 + 0.09 * i}, {0.95, 0.455, -0.135 + 0.09 * i});
  for (int i = 0; i < 3; ++i) shape.box({-0.95, 0.55 + 0.13 * i, -0.21}, {0.95, 0.64 + 0.13 * i, -0.18});
  return shape;
}

Shape bollards() {
  constexpr std::array<glm::dvec2, 6> kPost{
      {{0.1, 0}, {0.08, 0.1}, {0.07, 0.75}, {0.1, 0.8}, {0.08, 0.92}, {0, 0.97}}};
  Shape post, shape;
  post.lathe(kPost, 8);
  shape.paint(kIron);
  for (int i = -2; i <= 2; ++i) shape.append(post, translation({1.5 * i, 0, 0}));
  return shape;
}

Shape car(const glm::vec3& paint) {
  constexpr std::array<glm::dvec2, 8> kBody{{{-2.1, 0.28},
                                             {-1.2, 0.22},
                                             {1.2, 0.22},
                                             {2.1, 0.28},
                                             {2.1, 0.75},
                                             {1.1, 0.92},
                                             {-1.3, 0.95},
                                             {-2.15, 0.85}}};
  constexpr std::array<glm::dvec2, 4> kCabin{{{-1.75, 0.9}, {1.2, 0.9}, {0.45, 1.42}, {-1.15, 1.45}}};
  Shape shape = vehicle(kBody, kCabin, 0.86, paint);
  shape.paint(paint);
  shape.box({-1.2, 1.42, -0.7}, {0.45, 1.47, 0.7});
  for (const double z : {-0.95, 0.87}) shape.box({0.75, 0.92, z}, {0.9, 1.05, z + 0.08});  // mirrors
  addWheels(shape, 2.5, 0.8, 0.31);
  return shape;
}

Shape van(const glm::vec3& paint) {
  constexpr std::array<glm::dvec2, 8> kBody{{{-2.6, 0.35},
                                             {-1.4, 0.3},
                                             {1.5, 0.3},
                                             {2.5, 0.35},
                                             {2.5, 1.1},
                                             {1.6, 2.2},
                                             {-1.4, 2.35},
                                             {-2.6, 2.3}}};
  constexpr std::array<glm::dvec2, 4> kCabin{{{1.0, 1.2}, {2.42, 1.2}, {1.72, 2.02}, {1.0, 2.02}}};
  Shape shape = vehicle(kBody, kCabin, 1.1, paint);
  shape.paint(kSteel);
  for (const double z : {-0.7, 0.7}) shape.box({-2.2, 2.42, z - 0.03}, {1.0, 2.47, z + 0.03});
  for (const double x : {-2.0, -1.0, 0.0, 0.9}) shape.box({x, 2.3, -0.8}, {x + 0.06, 2.45, 0.8});
  addWheels(shape, 3.2, 1.0, 0.36);
  return shape;
}

Shape shelter() {
  Shape shape;
  shape.paint(kSteel);
  for (const double x : {-1.9, 0.0, 1.9}) shape.box({x - 0.04, 0, -0.7}, {x + 0.04, 2.4, -0.62});
  shape.box({-2.1, 2.4, -0.8}, {2.1, 2.5, 0.8});
  for (int i = 0; i < 12; ++i)
    shape.box({-1.85 + 0.31 * i, 0.4, -0.68}, {-1.82 + 0.31 * i, 2.2, -0.65});  // a lattice
  shape.paint(kTimber);
  shape.box({-1.5, 0.42, -0.6}, {1.5, 0.48, -0.2});
  return shape;
}

Shape planter() {
  constexpr std::array<glm::dvec2, 5> kPot{{{0.34, 0}, {0.46, 0.6}, {0.5, 0.6}, {0.44, 0.52}, {0, 0.5}}};
  Shape shape;
  shape.paint({0.42f, 0.2f, 0.12f});
  shape.lathe(kPot, 18);
  return shape;
}

Shape waterTank() {
  constexpr double kLegs = 2.6, kHeight = 3.2, kRadius = 1.5;
  Shape shape;
  shape.paint(kIron);
  for (int i = 0; i < 4; ++i) {
    const double x = (i < 2 ? -1 : 1) * 0.95, z = (i % 2 == 0 ? -1 : 1) * 0.95;
    shape.box({x - 0.08, 0, z - 0.08}, {x + 0.08, kLegs, z + 0.08});
  }
  for (const double side : {-0.95, 0.95}) {
    addRod(shape, {-0.95, 0.2, side}, {0.95, kLegs, side}, 0.04, 4);
    addRod(shape, {0.95, 0.2, side}, {-0.95, kLegs, side}, 0.04, 4);
    addRod(shape, {side, 0.2, -0.95}, {side, kLegs, 0.95}, 0.04, 4);
    addRod(shape, {side, 0.2, 0.95}, {side, kLegs, -0.95}, 0.04, 4);
  }
  shape.box({-1.5, kLegs, -1.5}, {1.5, kLegs + 0.12, 1.5});
  shape.paint(kTimber);
  const std::array<glm::dvec2, 4> barrel{{{kRadius, kLegs + 0.12},
                                          {kRadius * 0.94, kLegs + kHeight},
                                          {kRadius * 1.08, kLegs + kHeight},
                                          {0, kLegs + kHeight + 1.1}}};
  shape.lathe(barrel, 20);
  return shape;
}

Shape antennas() {
  Shape shape;
  shape.paint(kIron);
  addRod(shape, {0, 0, 0}, {0, 4.6, 0}, 0.04, 6);
  for (int i = 0; i < 7; ++i) {
    const double half = 0.75 - 0.07 * i, x = -0.6 + 0.22 * i;
    addRod(shape, {x, 4.2, -half}, {x, 4.2, half}, 0.012, 3);
  }
  addRod(shape, {-0.7, 4.2, 0}, {0.85, 4.2, 0}, 0.018, 4);
  for (int i = 0; i < 4; ++i)
    addRod(shape, {-0.25, 3.1 + 0.22 * i, -0.3}, {-0.25, 3.1 + 0.22 * i, 0.3}, 0.01, 3);
  // A dish on a post beside it.
  addRod(shape, {1.6, 0, 0.4}, {1.6, 1.3, 0.4}, 0.05, 6);
  shape.paint(kSteel);
  constexpr std::array<glm::dvec2, 4> kDish{{{0, 0}, {0.3, 0.04}, {0.5, 0.12}, {0.65, 0.24}}};
  Shape dish;
  dish.lathe(kDish, 14);
  shape.append(dish, translation({1.6, 1.35, 0.4}) * turnedZ(-0.13));
  return shape;
}

Shape vents() {
  Shape shape;
  shape.paint(kSteel * 0.8f);
  shape.box({-1.9, 0.25, -0.6}, {-0.4, 1.35, 0.6});
  shape.box({-0.4, 0.45, -0.25}, {2.4, 0.95, 0.25});
  shape.box({2.0, -0.1, -0.25}, {2.5, 0.95, 0.25});
  for (const double x : {-1.8, -0.6}) shape.box({x, 0, -0.55}, {x + 0.12, 0.25, 0.55});
  constexpr std::array<glm::dvec2, 4> kFan{{{0.42, 0}, {0.42, 0.2}, {0.36, 0.2}, {0.34, 0.02}}};
  Shape fan;
  fan.paint(kIron);
  fan.lathe(kFan, 12);
  shape.append(fan, translation({-1.15, 1.35, 0}));
  shape.paint(kSteel * 0.6f);
  constexpr std::array<glm::dvec2, 5> kCowl{{{0.14, 0}, {0.14, 0.9}, {0.3, 0.95}, {0.3, 1.15}, {0, 1.3}}};
  Shape cowl;
  cowl.lathe(kCowl, 10);
  for (int i = 0; i < 3; ++i) shape.append(cowl, translation({-0.2 + 0.9 * i, 0, -1.2}));
  return shape;
}

Shape liftHouse() {
  Shape shape;
  shape.paint({0.38f, 0.34f, 0.3f});
  shape.box({-2, 0, -1.5}, {2, 2.7, 1.5});
  shape.box({-2.2, 2.7, -1.7}, {2.2, 2.9, 1.7});
  shape.paint(kIron);
  shape.box({-0.5, 0, 1.5}, {0.5, 2.1, 1.55});
  for (int i = 0; i < 10; ++i)
    shape.box({2, 0.3 + 0.28 * i, 0.2}, {2.12, 0.34 + 0.28 * i, 0.75});  // a ladder
  return shape;
}

Shape wire(double span, double sag) {
  constexpr std::size_t kPoints = 7;
  std::array<glm::dvec3, kPoints> points;
  std::array<double, kPoints> radii;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double t = 2.0 * static_cast<double>(i) / (kPoints - 1) - 1;
    points[i] = {t * span / 2, sag * (t * t - 1), 0};
    radii[i] = 0.025;
  }
  Shape shape;
  shape.paint(kIron);
  shape.tube(points, radii, 4);
  return shape;
}

}  // namespace sundial::builtin
