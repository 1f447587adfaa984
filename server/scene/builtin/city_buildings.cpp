#include "scene/builtin/city_buildings.h"

#include <array>

namespace sundial::builtin {

namespace {

constexpr double kShops = 4.4, kStorey = 3.2, kOffice = 3.6, kParapet = 0.9;
constexpr glm::vec3 kIron{0.05f, 0.05f, 0.055f}, kLead{0.2f, 0.21f, 0.23f}, kGravel{0.3f, 0.29f, 0.27f};

// A box with a hole: a parapet or a ledge around a plan of half-sizes (x, z), `thick` inwards.
void addRim(Shape& shape, const glm::dvec2& half, double bottom, double top, double thick) {
  const glm::dvec2 in = half - thick;
  shape.box({-half.x, bottom, in.y}, {half.x, top, half.y});
  shape.box({-half.x, bottom, -half.y}, {half.x, top, -in.y});
  shape.box({-half.x, bottom, -in.y}, {-in.x, top, in.y});
  shape.box({in.x, bottom, -in.y}, {half.x, top, in.y});
}

// What faces the street on the ground: shop windows under awnings, and a door in the middle.
Shape shopFront(const Tenement& house) {
  constexpr glm::vec3 kAwnings[] = {{0.4f, 0.06f, 0.05f}, {0.06f, 0.22f, 0.12f}, {0.5f, 0.42f, 0.25f}};
  constexpr unsigned kShopsAlong = 5;
  const Window shop{
      .width = 3.4, .height = 2.9, .sill = 0.45, .recess = 0.3, .across = 3, .up = 1, .ledge = 0.1};
  const Window door{.width = 1.9, .height = 3.3, .sill = 0, .recess = 0.5, .across = 2, .up = 2};
  Shape shape;
  for (unsigned i = 0; i < kShopsAlong; ++i) {
    const double x0 = kLotWidth * i / kShopsAlong, x1 = kLotWidth * (i + 1) / kShopsAlong;
    addWindow(shape, {{x0, 0}, {x1, kShops}}, i == 2 ? door : shop, house.paints);
    if (i == 2 || (i + house.bays) % 3 == 0) continue;
    // A sheet without thickness, with a valance.
    shape.paint(kAwnings[(i + house.storeys) % 3]);
    const double low = 2.75, high = 3.5, out = 1.4;
    shape.quad({x0 + 0.3, low, out}, {x1 - 0.3, low, out}, {x1 - 0.3, high, 0}, {x0 + 0.3, high, 0});
    shape.quad({x0 + 0.3, low - 0.22, out}, {x1 - 0.3, low - 0.22, out}, {x1 - 0.3, low, out},
               {x0 + 0.3, low, out});
  }
  return shape;
}

// Ledges above the shops and under the roof, from x = 0 to the wall's end.
Shape ledges(double width, double height, bool hasBrackets, const glm::vec3& trim) {
  Shape shape;
  shape.paint(trim);
  shape.box({0, kShops - 0.25, 0}, {width, kShops, 0.16});
  shape.box({0, height - 0.5, 0}, {width, height - 0.2, 0.25});
  shape.box({0, height - 0.2, 0}, {width, height + 0.05, 0.55});
  if (hasBrackets)
    for (double x = 0.3; x < width - 0.3; x += 0.9)
      shape.box({x, height - 0.55, 0}, {x + 0.22, height - 0.2, 0.5});
  return shape;
}

void addBalconies(Shape& wall, const Tenement& house) {
  constexpr double kOut = 1.1, kWidth = 2.4;
  Shape balcony;
  balcony.paint(house.paints.trim);
  balcony.box({-kWidth / 2, -0.18, 0}, {kWidth / 2, 0, kOut});
  balcony.paint(kIron);
  balcony.append(railing(kWidth, 1, 7), translation({0, 0, kOut - 0.05}));
  for (const double x : {-1.0, 1.0})
    balcony.append(railing(kOut, 1, 2), translation({x * (kWidth / 2 - 0.05), 0, kOut / 2}) * turnedY(0.25));
  for (unsigned storey = 1; storey < house.storeys; ++storey)
    for (unsigned bay = 1; bay < house.bays; bay += 4) {
      const double x = kLotWidth * (bay + 0.5) / house.bays;
      wall.append(balcony, translation({x, kStorey * storey + house.window.sill, 0}));
    }
}

void addMansard(Shape& shape, double height, const Tenement& house) {
  constexpr double kRise = 3.1, kBack = 1.5;
  const double x = kLotWidth / 2, front = kLotDepth / 2, top = height + kRise, back = front - kBack;
  shape.paint(kLead);
  shape.quad({-x, height, front}, {x, height, front}, {x, top, back}, {-x, top, back});
  shape.quad({x, height, -front}, {-x, height, -front}, {-x, top, -back}, {x, top, -back});
  shape.quad({-x, top, back}, {x, top, back}, {x, top, -back}, {-x, top, -back});
  for (const double side : {0.25, 0.75}) {
    Shape end;
    end.paint(house.paints.wall);
    end.quad({-front, 0, 0}, {front, 0, 0}, {back, kRise, 0}, {-back, kRise, 0});
    shape.append(end, translation({0, height, 0}) * turnedY(side) * translation({0, 0, x}));
  }
  Shape dormer;
  const Bay bay{{-0.95, 0}, {0.95, 2.4}};
  addWindow(dormer, bay, {.width = 1.2, .height = 1.6, .sill = 0.45, .across = 2, .up = 2}, house.paints);
  dormer.paint(kLead);
  dormer.box({-1.05, 2.4, -kBack - 0.2}, {1.05, 2.55, 0.2});
  for (const double s : {-0.95, 0.95}) dormer.box({s - 0.05, 0, -kBack}, {s + 0.05, 2.4, -0.01});
  for (unsigned i = 0; i < house.bays; i += 2)
    shape.append(dormer,
                 translation({kLotWidth * ((i + 0.5) / house.bays - 0.5), height + 0.25, front - 0.1}));
}

// Stacks on the party walls, each with a row of pots.
void addChimneys(Shape& shape, double roof) {
  constexpr std::array<glm::dvec2, 3> kPot{{{0.15, 0}, {0.12, 0.55}, {0.08, 0.55}}};
  Shape pot;
  pot.lathe(kPot, 6);
  for (const double z : {-3.4, 2.6}) {
    const double x = kLotWidth / 2 - 0.5;
    shape.paint({0.3f, 0.16f, 0.1f});
    shape.box({x - 0.4, roof - 1.5, z - 1.1}, {x + 0.4, roof + 1.5, z + 1.1});
    shape.box({x - 0.5, roof + 1.5, z - 1.2}, {x + 0.5, roof + 1.65, z + 1.2});
    shape.paint({0.42f, 0.17f, 0.09f});
    for (int i = 0; i < 3; ++i) shape.append(pot, translation({x, roof + 1.65, z - 0.7 + 0.7 * i}));
  }
}

}  // namespace

double tenementHeight(const Tenement& house) { return kShops + kStorey * house.storeys; }

Shape tenement(const Tenement& house, bool isCorner) {
  const double height = tenementHeight(house), upper = height - kShops;
  Shape shape;
  Window plain = house.window;
  plain.across = plain.up = 1;
  plain.ledge = plain.shutters = 0;
  unsigned side = 0;
  eachSide(kLotWidth, kLotDepth, [&](double width, const glm::dmat4& place) {
    const bool isFront = side == 0, isEnd = side % 2 == 1;
    Shape wall;
    if (isEnd && !isCorner) {
      wall.paint(house.paints.wall * 0.85f);
      wall.quad({0, 0, 0}, {width, 0, 0}, {width, height, 0}, {0, height, 0});
    } else {
      const unsigned columns = isEnd ? house.bays * 2 / 5 : house.bays;
      Shape windows =
          wallOfWindows({width, upper}, columns, house.storeys, isFront ? house.window : plain, house.paints);
      if (isFront && house.hasBalconies) addBalconies(windows, house);
      wall.append(windows, translation({0, kShops, 0}));
      if (isFront) {
        wall.append(shopFront(house), glm::dmat4(1));
      } else {
        wall.paint(house.paints.wall);
        wall.quad({0, 0, 0}, {width, 0, 0}, {width, kShops, 0}, {0, kShops, 0});
      }
      wall.append(ledges(width, height, house.hasBrackets && isFront, house.paints.trim), glm::dmat4(1));
    }
    shape.append(wall, place);
    ++side;
  });
  if (house.roof == Roof::mansard) {
    addMansard(shape, height, house);
    addChimneys(shape, height + 3.1);
  } else {
    const glm::dvec2 half(kLotWidth / 2, kLotDepth / 2);
    shape.paint(kGravel);
    shape.quad({-half.x, height, half.y}, {half.x, height, half.y}, {half.x, height, -half.y},
               {-half.x, height, -half.y});
    shape.paint(house.paints.wall);
    addRim(shape, half, height, height + kParapet, 0.3);
    addChimneys(shape, height);
  }
  return shape;
}

Shape tower(std::span<const Tier> tiers, const WallPaints& paints) {
  Shape shape;
  double foot = 0;
  for (const auto& [half, storeys] : tiers) {
    const double height = kOffice * storeys;
    const auto bays = static_cast<unsigned>(half * 2 / 2.7);
    const Window pane{.width = half * 2 / bays - 0.5, .height = 2.7, .sill = 0.6, .recess = 0.2};
    eachSide(half * 2, half * 2, [&](double width, const glm::dmat4& place) {
      Shape wall = wallOfWindows({width, height}, bays, storeys, pane, paints);
      wall.paint(paints.trim);
      for (unsigned i = 0; i <= bays; ++i) {
        const double x = width * i / bays;
        wall.box({x - 0.12, 0, 0}, {x + 0.12, height + 0.6, 0.45});
      }
      shape.append(wall, translation({0, foot, 0}) * place);
    });
    foot += height;
    shape.paint(kGravel);
    shape.quad({-half, foot, half}, {half, foot, half}, {half, foot, -half}, {-half, foot, -half});
    shape.paint(paints.wall);
    addRim(shape, glm::dvec2(half), foot, foot + 1.2, 0.4);
  }
  // Cooling towers around a lift house, and a guyed mast.
  const double half = tiers.back().half;
  shape.paint(kLead);
  shape.box({-half * 0.4, foot, -half * 0.4}, {half * 0.4, foot + 5, half * 0.4});
  constexpr std::array<glm::dvec2, 5> kCooler{{{1.1, 0}, {1.1, 1.9}, {0.8, 2.3}, {0.9, 2.6}, {0.7, 2.6}}};
  Shape cooler;
  cooler.lathe(kCooler, 14);
  for (const double x : {-0.7, 0.7})
    for (const double z : {-0.7, 0.0, 0.7}) shape.append(cooler, translation({half * x, foot, half * z}));
  shape.paint(kIron);
  constexpr double kMast = 16;
  const std::array<glm::dvec3, 3> mast{
      {{0, foot + 5, 0}, {0, foot + 5 + kMast / 2, 0}, {0, foot + 5 + kMast, 0}}};
  constexpr std::array<double, 3> kMastRadii{0.28, 0.2, 0.05};
  shape.tube(mast, kMastRadii, 8);
  constexpr std::array<double, 2> kGuy{0.03, 0.03};
  for (int i = 0; i < 4; ++i) {
    const double turn = 0.25 * i + 0.125;
    const std::array<glm::dvec3, 2> guy{
        glm::dvec3{half * 0.9 * sinTurns(turn), foot, half * 0.9 * cosTurns(turn)},
        glm::dvec3{0, foot + 15, 0}};
    shape.tube(guy, kGuy, 3);
  }
  return shape;
}

Shape marketHall() {
  constexpr double kHeight = 6, kTooth = 2.4;
  constexpr unsigned kTeeth = 8;
  Shape shape;
  shape.paint(kIron * 2.0f);
  constexpr std::array<glm::dvec2, 6> kColumn{
      {{0.3, 0}, {0.3, 0.3}, {0.16, 0.45}, {0.13, kHeight - 0.5}, {0.3, kHeight - 0.1}, {0.3, kHeight}}};
  Shape column;
  column.lathe(kColumn, 7);
  const double x = kLotWidth / 2, z = kLotDepth / 2;
  for (unsigned i = 0; i <= kTeeth; ++i)
    for (const double row : {-0.9, 0.0, 0.9})
      shape.append(column, translation({(2.0 * i / kTeeth - 1) * (x - 0.4), 0, row * z}));
  shape.box({-x, kHeight, -z}, {x, kHeight + 0.25, -z + 0.3});
  shape.box({-x, kHeight, z - 0.3}, {x, kHeight + 0.25, z});
  // Teeth with glazing bars but no glass: light falls through.
  for (unsigned i = 0; i < kTeeth; ++i) {
    const double from = -x + kLotWidth * i / kTeeth, to = -x + kLotWidth * (i + 1) / kTeeth;
    shape.paint(kLead);
    shape.quad({from, kHeight + 0.25, z}, {to, kHeight + 0.25 + kTooth, z}, {to, kHeight + 0.25 + kTooth, -z},
               {from, kHeight + 0.25, -z});
    shape.paint(kIron);
    for (unsigned bar = 0; bar <= 14; ++bar) {
      const double at = -z + kLotDepth * bar / 14;
      shape.box({to - 0.06, kHeight + 0.25, at - 0.03}, {to, kHeight + 0.25 + kTooth, at + 0.03});
    }
  }
  return shape;
}

}  // namespace sundial::builtin
