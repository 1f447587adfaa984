#include "scene/builtin/village_parts.h"

#include <array>

namespace sundial::builtin {

namespace {

constexpr double kStorey = 2.8, kFoundation = 2.5;
constexpr glm::vec3 kLime{0.6f, 0.56f, 0.48f}, kSlate{0.13f, 0.14f, 0.16f}, kPane{0.05f, 0.07f, 0.09f};

// The wall between the eaves and the ridge, both halves, seen from +z: `span` along x.
void addGable(Shape& shape, double span, double rise) {
  const double half = span / 2;
  // A quad whose fourth corner lies on a triangle's longest side is that triangle.
  shape.quad({0, 0, 0}, {0, rise, 0}, {-half / 2, rise / 2, 0}, {-half, 0, 0});
  shape.quad({half, 0, 0}, {half / 2, rise / 2, 0}, {0, rise, 0}, {0, 0, 0});
}

// Posts at the bays' corners, a beam a storey, and a brace in each end bay.
Shape timbers(const glm::dvec2& size, unsigned columns, unsigned rows) {
  constexpr double kBeam = 0.09, kProud = 0.035;
  Shape shape;
  shape.paint(kWood);
  for (unsigned i = 0; i <= columns; ++i) {
    const double x = glm::mix(kBeam, size.x - kBeam, static_cast<double>(i) / columns);
    shape.box({x - kBeam, 0, 0}, {x + kBeam, size.y, kProud});
  }
  for (unsigned j = 0; j <= rows; ++j) {
    const double y = glm::mix(kBeam, size.y - kBeam, static_cast<double>(j) / rows);
    shape.box({0, y - kBeam, 0}, {size.x, y + kBeam, kProud + 0.01});
  }
  return shape;
}

void addChimney(Shape& shape, const glm::dvec3& foot, double height) {
  Shape chimney;
  chimney.paint(kStone);
  chimney.box({-0.4, -1.5, -0.3}, {0.4, height, 0.3});
  chimney.box({-0.5, height, -0.4}, {0.5, height + 0.14, 0.4});
  chimney.paint({0.42f, 0.17f, 0.09f});
  constexpr std::array<glm::dvec2, 5> kPot{{{0.14, 0}, {0.11, 0.42}, {0.15, 0.5}, {0.1, 0.5}, {0.08, 0.1}}};
  for (const double x : {-0.2, 0.2}) {
    Shape pot;
    pot.lathe(kPot, 8);
    chimney.append(pot, translation({x, height + 0.14, 0}));
  }
  shape.append(chimney, translation(foot));
}

void addShed(Shape& shape, const House& house, Random& random) {
  constexpr double kWidth = 3.4, kHeight = 2.1, kRise = 1.2;
  const double depth = house.depth * 0.62;
  Shape shed;
  shed.paint(kWood * 1.5f);
  shed.box({-kWidth / 2, -kFoundation, -depth / 2}, {kWidth / 2, kHeight, depth / 2});
  shed.paint(kWood);
  for (double x = -kWidth / 2; x < kWidth / 2; x += 0.34)  // battens
    shed.box({x, 0, depth / 2}, {x + 0.06, kHeight, depth / 2 + 0.03});
  // Its ridge runs from front to back.
  shed.append(gableRoof({.length = depth, .span = kWidth, .rise = kRise, .overhang = 0.3, .tile = 0.7},
                        house.tiles * 0.8f, kWood, random),
              translation({0, kHeight, 0}) * turnedY(0.25));
  Shape gable;
  gable.paint(kWood * 1.5f);
  addGable(gable, kWidth, kRise);
  shed.append(gable, translation({0, kHeight, depth / 2}));
  shed.append(gable, translation({0, kHeight, -depth / 2}) * turnedY(0.5));
  shape.append(shed, translation({house.width / 2 + kWidth / 2, 0, -house.depth * 0.15}));
}

// What is around a door: its frame, two steps and a canopy on struts.
void addPorch(Shape& shape, const glm::dvec3& at) {
  Shape door;
  door.paint(kWood);
  door.box({-0.68, 0, 0}, {-0.55, 2.3, 0.08});
  door.box({0.55, 0, 0}, {0.68, 2.3, 0.08});
  door.box({-0.68, 2.15, 0}, {0.68, 2.3, 0.08});
  door.paint(kStone);
  door.box({-0.9, -0.9, 0}, {0.9, -0.02, 0.9});
  door.box({-0.9, -0.9, 0.9}, {0.9, -0.22, 1.25});
  door.paint(kWood);
  door.box({-1.0, 2.55, 0}, {1.0, 2.63, 1.0});
  constexpr std::array<double, 2> kRadii{0.045, 0.045};
  for (const double x : {-0.9, 0.9}) {
    const std::array<glm::dvec3, 2> strut{glm::dvec3{x, 1.9, 0}, glm::dvec3{x, 2.56, 0.9}};
    door.tube(strut, kRadii, 4);
  }
  shape.append(door, translation(at));
}

}  // namespace

Shape house(const House& house, Random& random) {
  const auto& [width, depth, storeys, rise, isTimbered, hasShed, paints, tiles] = house;
  const double height = kStorey * storeys;
  Shape shape;
  shape.paint(kStone);
  shape.box({-width / 2 - 0.06, -kFoundation, -depth / 2 - 0.06}, {width / 2 + 0.06, 0, depth / 2 + 0.06});

  const Window window{.width = 0.95,
                      .height = 1.25,
                      .sill = 0.95,
                      .recess = 0.18,
                      .across = 2,
                      .up = 2,
                      .ledge = 0.12,
                      .shutters = isTimbered ? 0.0 : 0.45};
  const Window door{.width = 1.1, .height = 2.15, .sill = 0, .recess = 0.2};
  const WallPaints doorPaints{paints.wall, paints.trim, kWood * 1.3f};
  const auto columnsOf = [](double side) { return static_cast<unsigned>(side / 2.5); };
  bool isFront = true;
  eachSide(width, depth, [&](double side, const glm::dmat4& place) {
    const unsigned columns = columnsOf(side);
    const double bay = side / columns;
    Shape wall;
    for (unsigned column = 0; column < columns; ++column) {
      const Bay ground{{bay * column, 0}, {bay * (column + 1), kStorey}};
      const bool isDoor = isFront && column == 1;
      addWindow(wall, ground, isDoor ? door : window, isDoor ? doorPaints : paints);
    }
    if (storeys > 1)
      wall.append(wallOfWindows({side, height - kStorey}, columns, storeys - 1, window, paints),
                  translation({0, kStorey, 0}));
    if (isTimbered) wall.append(timbers({side, height}, columns, storeys), glm::dmat4(1));
    shape.append(wall, place);
    isFront = false;
  });
  addPorch(shape, {-width / 2 + 1.5 * width / columnsOf(width), 0, depth / 2});

  Shape gable;
  gable.paint(isTimbered ? kWood * 1.8f : paints.wall);
  addGable(gable, depth, rise);
  for (const double turn : {0.25, 0.75})
    shape.append(gable, translation({0, height, 0}) * turnedY(turn) * translation({0, 0, width / 2}));
  shape.append(gableRoof({.length = width, .span = depth, .rise = rise}, tiles, kWood, random),
               translation({0, height, 0}));
  addChimney(shape, {width * random.range(0.22, 0.36), height + rise * 0.75, -depth * 0.12},
             rise * 0.25 + 0.9);
  if (hasShed) addShed(shape, house, random);
  return shape;
}

Shape church(Random& random) {
  constexpr double kLength = 20, kSpan = 9.5, kHeight = 6.5, kRise = 6;
  constexpr double kTower = 5.6, kTowerHeight = 17, kSpire = 11;
  const WallPaints paints{kLime, kStone, kPane};
  Shape shape;
  shape.paint(kStone);
  shape.box({-kLength / 2 - 0.2, -kFoundation, -kSpan / 2 - 0.2}, {kLength / 2, 0.5, kSpan / 2 + 0.2});
  const Window tall{
      .width = 1.1, .height = 3.9, .sill = 1.5, .recess = 0.4, .across = 2, .up = 5, .ledge = 0.2};
  eachSide(kLength, kSpan, [&](double side, const glm::dmat4& place) {
    const auto bays = static_cast<unsigned>(side / 4);
    shape.append(wallOfWindows({side, kHeight}, bays, 1, tall, paints), place);
    Shape buttresses;
    buttresses.paint(kStone);
    for (unsigned i = 0; i <= bays; ++i) {
      const double x = side * i / bays;
      buttresses.box({x - 0.35, -kFoundation, 0}, {x + 0.35, kHeight * 0.55, 0.95});
      buttresses.box({x - 0.3, kHeight * 0.55, 0}, {x + 0.3, kHeight * 0.85, 0.5});
    }
    shape.append(buttresses, place);
  });
  Shape gable;
  gable.paint(kLime);
  addGable(gable, kSpan, kRise);
  for (const double turn : {0.25, 0.75})
    shape.append(gable, translation({0, kHeight, 0}) * turnedY(turn) * translation({0, 0, kLength / 2}));
  shape.append(gableRoof({.length = kLength, .span = kSpan, .rise = kRise}, kSlate, kWood, random),
               translation({0, kHeight, 0}));

  Shape tower;
  tower.paint(kStone);
  tower.box({-kTower / 2 - 0.2, -kFoundation, -kTower / 2 - 0.2}, {kTower / 2 + 0.2, 0.5, kTower / 2 + 0.2});
  const Window slit{.width = 0.5, .height = 2, .sill = 1.6, .recess = 0.5};
  const Window belfry{
      .width = 1.2, .height = 2.6, .sill = 0.8, .recess = 0.7, .across = 1, .up = 7, .ledge = 0.15};
  constexpr double kBelfry = 4.4;
  eachSide(kTower, kTower, [&](double side, const glm::dmat4& place) {
    tower.append(wallOfWindows({side, kTowerHeight - kBelfry}, 1, 2, slit, paints), place);
    tower.append(wallOfWindows({side, kBelfry}, 2, 1, belfry, paints),
                 place * translation({0, kTowerHeight - kBelfry, 0}));
  });
  tower.paint(kStone);
  for (const double y : {kTowerHeight - kBelfry, kTowerHeight}) {
    const double half = kTower / 2 + 0.22;
    tower.box({-half, y - 0.15, -half}, {half, y + 0.2, half});
  }
  for (const double x : {-1.0, 1.0})
    for (const double z : {-1.0, 1.0}) {
      const glm::dvec3 at(x * kTower / 2, kTowerHeight + 0.2, z * kTower / 2);
      tower.box(at - glm::dvec3(0.3, 0, 0.3), at + glm::dvec3(0.3, 1.1, 0.3));
    }
  Shape spire;
  spire.paint(kSlate);
  constexpr std::array<glm::dvec2, 4> kProfile{{{3.7, 0}, {3.0, 1.2}, {1.2, 6}, {0.06, kSpire}}};
  spire.lathe(kProfile, 8);
  spire.paint(kIron);
  spire.box({-0.05, kSpire - 0.2, -0.05}, {0.05, kSpire + 1.7, 0.05});
  spire.box({-0.05, kSpire + 0.9, -0.45}, {0.05, kSpire + 1.0, 0.45});
  tower.append(spire, translation({0, kTowerHeight + 0.2, 0}));
  shape.append(tower, translation({kLength / 2 + kTower / 2 - 0.3, 0, 0}));
  return shape;
}

Shape well(Random& random) {
  Shape shape;
  shape.paint(kStone);
  constexpr std::array<glm::dvec2, 6> kRing{
      {{1.25, -1}, {1.2, 0.8}, {1.3, 0.8}, {1.3, 0.95}, {0.85, 0.95}, {0.85, -0.5}}};
  shape.lathe(kRing, 28);
  shape.paint(kPane);
  constexpr std::array<glm::dvec2, 2> kWater{{{0.86, -0.4}, {0, -0.4}}};
  shape.lathe(kWater, 28);
  shape.paint(kWood);
  constexpr std::array<double, 2> kThick{0.07, 0.07}, kThin{0.025, 0.025};
  for (const double x : {-1.07, 1.07}) shape.box({x - 0.09, 0.3, -0.09}, {x + 0.09, 2.75, 0.09});
  const std::array<glm::dvec3, 2> drum{glm::dvec3{-1.2, 1.7, 0}, glm::dvec3{1.25, 1.7, 0}};
  shape.tube(drum, kThick, 10);
  const std::array<glm::dvec3, 4> crank{
      {{1.25, 1.7, 0}, {1.32, 1.7, 0}, {1.32, 1.35, 0.15}, {1.6, 1.35, 0.15}}};
  constexpr std::array<double, 4> kCrank{0.025, 0.025, 0.025, 0.025};
  shape.tube(crank, kCrank, 6);
  const std::array<glm::dvec3, 2> rope{glm::dvec3{0.1, 0.75, 0.07}, glm::dvec3{0.1, 1.7, 0.07}};
  shape.tube(rope, kThin, 5);
  Shape bucket;
  bucket.paint(kWood * 1.4f);
  constexpr std::array<glm::dvec2, 5> kBucket{{{0, 0}, {0.17, 0}, {0.22, 0.36}, {0.19, 0.36}, {0.15, 0.05}}};
  bucket.lathe(kBucket, 12);
  shape.append(bucket, translation({0.1, 0.4, 0.07}));
  shape.append(gableRoof({.length = 2.5, .span = 2.2, .rise = 0.9, .overhang = 0.2, .tile = 0.25},
                         {0.3f, 0.12f, 0.06f}, kWood, random),
               translation({0, 2.75, 0}));
  return shape;
}

}  // namespace sundial::builtin
