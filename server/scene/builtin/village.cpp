// A village on a terraced hill, as one mesh of one material: its bounds tell nothing, so that a shadow method
// that culls by them draws all of it for each of its maps. Alecu (2014, section 4.3) calls such a scene the
// worst case of Irregular Adaptive Shadow Maps; culling by clusters takes that back.
#include <array>
#include <cmath>

#include "scene/builtin/builtin.h"
#include "scene/builtin/tree_parts.h"
#include "scene/builtin/village_ground.h"
#include "scene/builtin/village_parts.h"

namespace sundial::builtin {

namespace {

constexpr std::array<Parameter, 1> kParameters{{{"seed", 0, 4294967295, 1, "which village"}}};

constexpr std::array<glm::vec3, 6> kPlaster{{{0.62f, 0.56f, 0.44f},
                                             {0.68f, 0.66f, 0.6f},
                                             {0.6f, 0.44f, 0.22f},
                                             {0.58f, 0.38f, 0.3f},
                                             {0.4f, 0.46f, 0.48f},
                                             {0.52f, 0.5f, 0.36f}}};
constexpr std::array<glm::vec3, 4> kTiles{
    {{0.33f, 0.12f, 0.06f}, {0.38f, 0.16f, 0.09f}, {0.24f, 0.12f, 0.08f}, {0.2f, 0.19f, 0.19f}}};
constexpr std::array<glm::vec3, 4> kTrims{
    {{0.5f, 0.48f, 0.44f}, {0.1f, 0.2f, 0.12f}, {0.12f, 0.18f, 0.3f}, {0.28f, 0.07f, 0.05f}}};
constexpr glm::vec3 kPane{0.05f, 0.07f, 0.09f};

template <std::size_t n>
const glm::vec3& anyOf(const std::array<glm::vec3, n>& colours, Random& random) {
  return colours[random.below(n)];
}

House anyHouse(Random& random) {
  House house{};
  house.width = random.range(8, 11.5);
  house.depth = random.range(6.4, 7.8);
  house.storeys = random.unit() < 0.45 ? 2 : 1;
  house.rise = house.depth * random.range(0.42, 0.6);
  house.isTimbered = random.unit() < 0.35;
  house.hasShed = random.unit() < 0.4;
  house.paints = {anyOf(kPlaster, random), anyOf(kTrims, random), kPane};
  house.tiles = anyOf(kTiles, random);
  return house;
}

// A part of a fence, 1 long along x: it is stretched from one point of the ground to the next.
Shape pickets() {
  constexpr int kPickets = 6;
  Shape panel;
  panel.paint({0.55f, 0.53f, 0.48f});
  for (int i = 0; i < kPickets; ++i) {
    const double x = (i + 0.25) / kPickets;
    panel.box({x, 0.06, -0.012}, {x + 0.04, i % 2 == 0 ? 1.02 : 0.96, 0.012});
  }
  for (const double y : {0.25, 0.75}) panel.box({0, y, -0.045}, {1, y + 0.07, -0.012});
  panel.box({-0.025, -0.4, -0.1}, {0.025, 1.1, -0.045});
  return panel;
}

Shape rails() {
  Shape panel;
  panel.paint(kWood * 1.6f);
  for (const double y : {0.45, 0.9}) panel.box({0, y, -0.03}, {1, y + 0.09, 0.03});
  panel.box({-0.03, -0.4, -0.07}, {0.03, 1.15, 0.07});
  return panel;
}

// Two rough stones of a dry wall.
Shape stones(Random& random) {
  Shape panel;
  for (const double x : {0.0, 0.5}) {
    const double height = random.range(0.45, 0.8), deep = random.range(0.2, 0.3);
    panel.paint(kStone * static_cast<float>(random.range(0.75, 1.2)));
    panel.box({x + 0.01, -0.9, -deep}, {x + 0.49, height, deep});
  }
  return panel;
}

// Stretches panel() after panel along a line of the ground; at(t), t in [0, 1], is the line.
template <class At, class Panel>
void addAlong(Shape& village, double length, At at, Panel panel) {
  const int count = static_cast<int>(std::ceil(length / 2));
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 from = at(static_cast<double>(i) / count), to = at((i + 1.0) / count);
    const glm::dvec3 along = to - from, across = glm::normalize(glm::dvec3(-along.z, 0, along.x));
    village.append(panel(), glm::dmat4({along, 0}, {0, 1, 0, 0}, {across, 0}, {from, 1}));
  }
}

void addLaundry(Shape& village, const glm::dmat4& place, Random& random) {
  constexpr double kHeight = 1.9;
  Shape line;
  line.paint(kWood);
  for (const double x : {-2.5, 2.5}) line.box({x - 0.05, -0.5, -0.05}, {x + 0.05, kHeight + 0.1, 0.05});
  const std::array<glm::dvec3, 3> rope{{{-2.5, kHeight, 0}, {0, kHeight - 0.08, 0}, {2.5, kHeight, 0}}};
  constexpr std::array<double, 3> kRadii{0.008, 0.008, 0.008};
  line.tube(rope, kRadii, 3);
  for (int i = 0; i < 4; ++i) {
    const double x = -2.2 + 1.1 * i, drop = random.range(0.6, 1.3), phase = random.unit();
    line.paint(glm::mix(glm::vec3(0.7f), anyOf(kTrims, random), i % 2 == 0 ? 0.1f : 0.7f));
    line.surface(6, 4, [&](double u, double v) {
      return glm::dvec3(x + 0.9 * u, kHeight - 0.06 - drop * (1 - v),
                        0.08 * (1 - v) * sinTurns(1.5 * u + phase));
    });
  }
  village.append(line, place);
}

void addTree(Shape& village, const Tree& tree, const glm::vec3& leaf, const glm::dmat4& place) {
  village.paint({0.14f, 0.1f, 0.07f});
  village.append(tree.wood, place);
  village.paint(leaf);
  village.append(tree.leaves, place);
}

// A row of houses behind the lane of a terrace, with front gardens, fences, and orchards behind.
void addRow(Shape& village, int terrace, Random& random) {
  const Shape picketPanel = pickets(), railPanel = rails();
  const Tree fruit = broadleaf({.boughs = 7, .cards = 18, .card = 0.6}, random);
  for (double x = -104; x < 104;) {
    const House plan = anyHouse(random);
    const double half = random.range(8.6, 10.2);
    x += half;
    const glm::dvec3 at = onTerrace(terrace, random.range(0.42, 0.48), x, 0.35);
    const double turn = random.range(-0.015, 0.015);
    const bool isFree = glm::distance(glm::dvec2(at.x, at.z), kVillageSquare) > kSquareRadius + 10 &&
                        std::abs(x) > 15 && random.unit() < 0.84;
    if (isFree) {
      village.append(house(plan, random), translation(at) * turnedY(turn));
      const std::uint32_t kind = random.below(3);
      for (const double side : {-1.0, 1.0}) {
        const auto front = [&](double t) {
          return onTerrace(terrace, 0.23, x + side * (1.1 + (half - 1.3) * t));
        };
        if (kind == 0) addAlong(village, half - 1.3, front, [&] { return stones(random); });
        if (kind > 0) addAlong(village, half - 1.3, front, [&]() -> const Shape& { return picketPanel; });
      }
      const auto side = [&](double t) { return onTerrace(terrace, 0.23 + 0.48 * t, x + half - 0.2); };
      addAlong(village, 16, side, [&]() -> const Shape& { return railPanel; });
      if (random.unit() < 0.6) {
        const double size = random.range(0.6, 0.8), spin = random.unit();
        addTree(
            village, fruit, {0.16f, 0.25f, 0.06f},
            translation(onTerrace(terrace, 0.3, x - half + 2.5)) * turnedY(spin) * scaling(glm::dvec3(size)));
      }
      if (random.unit() < 0.35)
        addLaundry(village, translation(onTerrace(terrace, 0.68, x - 1)) * turnedY(turn), random);
    }
    x += half;
  }
  // A dry wall along the terrace's lower edge, open where the path climbs.
  for (const double side : {-1.0, 1.0}) {
    const auto edge = [&](double t) { return onTerrace(terrace, 0.0, side * (14 + 96 * t)); };
    addAlong(village, 96, edge, [&] { return stones(random); });
  }
}

void addSquare(Shape& village, Random& random) {
  const auto& [x, z] = std::pair(kVillageSquare.x, kVillageSquare.y);
  village.append(church(random), translation(onVillageGround(x - 4, z - 19)));
  village.append(well(random), translation(onVillageGround(x + 5, z + 3)) * turnedY(0.06));
  for (const double side : {-1.0, 1.0})
    for (const double along : {-4.0, 13.0}) {
      House plan = anyHouse(random);
      plan.storeys = 2;
      plan.hasShed = false;
      village.append(house(plan, random), translation(onVillageGround(x + side * 25, z + along, 0.3)) *
                                              turnedY(side < 0 ? 0.25 : 0.75));
    }
  const Tree lime = broadleaf({.boughs = 13, .cards = 50, .card = 0.65}, random);
  addTree(village, lime, {0.13f, 0.24f, 0.06f},
          translation(onVillageGround(x - 9, z + 5)) * scaling(glm::dvec3(1.15)));
}

void addWood(Shape& village, Random& random) {
  const std::array<Tree, 2> firs{conifer(random), conifer(random)};
  for (int i = 0; i < 10; ++i) {
    const double x = random.range(-125, 125), along = random.range(0.1, 0.9);
    const double size = random.range(0.8, 1.3), spin = random.unit();
    addTree(
        village, firs[static_cast<std::size_t>(i) % 2], {0.05f, 0.12f, 0.05f},
        translation(onTerrace(i % 4 == 0 ? -4 : 2, along, x)) * turnedY(spin) * scaling(glm::dvec3(size)));
  }
}

void makeVillage(SceneBuilder& builder, const Values& values) {
  Random random(values[0]);
  Shape village = villageGround();
  for (int terrace = -3; terrace <= 1; ++terrace) addRow(village, terrace, random);
  addSquare(village, random);
  addWood(village, random);
  std::vector<Primitive> primitives;
  primitives.push_back(std::move(village).take(addColour(builder, "painted", glm::vec3(1), true)));
  builder.addInstance("village", builder.addMesh("village", std::move(primitives)), glm::dmat4(1));

  const auto above = [](double x, double z, double height) { return onVillageGround(x, z, height); };
  const glm::dvec2 square = kVillageSquare;
  builder.addView(view("main", above(44, 50, 22), above(-3, -13, 1), 52));
  builder.addView(
      view("lane", onTerrace(-1, kLaneAlong, -62, 1.7), onTerrace(-1, kLaneAlong + 0.04, -30, 2), 60));
  builder.addView(
      view("square", above(square.x + 13, square.y + 17, 1.7), above(square.x - 4, square.y - 14, 5), 65));
  builder.addView(view("fence", onTerrace(-2, 0.19, 33, 1.0), onTerrace(-2, 0.3, 48, 0.7), 55));
  builder.addView(view("above", {-120, 105, 130}, {0, 0, -5}, 50));
  builder.addLight(sun("sun", 50, 0.01));
  builder.addLight(sun("low", 5, 0.04));
  builder.addLight(sun("noon", 80, 0.2));
  builder.addLight(spot("spot", above(18, 24, 34), above(-2, -14, 0), 80));
  const auto stroll = [](double x, double ahead) {
    return view("", onTerrace(-1, kLaneAlong, x, 1.7), onTerrace(-1, kLaneAlong + 0.03, x + ahead, 2.2), 60)
        .view;
  };
  builder.addPath({"walk", {stroll(-70, 20), stroll(-50, 18), stroll(-30, 18), stroll(-10, 16)}, 240});
  builder.addPath(
      {"fly-over",
       {view("", {-110, 45, 100}, {-40, 0, 10}, 55).view, view("", {-40, 28, 60}, {0, 2, -15}, 55).view,
        view("", {40, 30, 30}, {30, 4, -50}, 55).view, view("", {90, 42, -20}, {20, 8, -80}, 55).view},
       240});
}

}  // namespace

const Row kVillage{"village", "a village on a terraced hill, all in one mesh", kParameters, makeVillage};

}  // namespace sundial::builtin
