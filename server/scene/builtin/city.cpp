// A city of perimeter blocks along an avenue of one kilometre: tenements wall to wall around courtyards, a
// few towers, parks and market halls, what stands on roofs and in streets. Instanced as a real one would be.
#include <array>

#include "scene/builtin/city_ground.h"
#include "scene/builtin/city_kit.h"

namespace sundial::builtin {

namespace {

constexpr std::array<Parameter, 1> kParameters{{{"seed", 0, 4294967295, 1, "which city"}}};

enum class Use { houses, tower, park, market };

// From a flat roof of this block's house at the avenue one looks along it; a sapling stands before the house.
constexpr int kViewRow = 6;
constexpr std::size_t kViewTenement = 9;
constexpr glm::dvec3 kSapling{-kRoad - 1.1, kKerb, 9};

class City {
 public:
  City(SceneBuilder& builder, std::uint64_t seed)
      : builder_(builder), random_(seed), kit_(addCityKit(builder, random_)) {}

  void build() {
    addGround();
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column)
        for (const double side : {-1.0, 1.0}) {
          const glm::dvec3 middle(side * (kFirst + kPitchX * column), kKerb,
                                  kPitchZ * (row - (kRows - 1) / 2.0));
          const bool isView = side > 0 && column == 0 && row == kViewRow;
          addBlock(middle, column, isView);
        }
    addAvenue();
  }

  double viewRoof() const { return kKerb + kit_.tenements[kViewTenement].height; }

 private:
  void place(const char* name, std::uint32_t mesh, const glm::dmat4& where) {
    builder_.addInstance(name, mesh, where);
  }

  void addGround() {
    place("road", addPainted(builder_, "road", cityRoad(), kit_.paint), glm::dmat4(1));
    pavement_ = addPainted(builder_, "pavement", cityPavement(), kit_.paint);
    lawn_ = addPainted(builder_, "lawn", cityLawn(), kit_.paint);
  }

  Use useOf(int column, bool isView) {
    const double any = random_.unit();
    if (isView) return Use::houses;
    if (any < (column == 0 ? 0.17 : 0.1)) return Use::tower;
    if (any > 0.92) return Use::park;
    return any > 0.88 ? Use::market : Use::houses;
  }

  void addBlock(const glm::dvec3& middle, int column, bool isView) {
    const glm::dmat4 here = translation(middle);
    place("pavement", pavement_, here);
    switch (useOf(column, isView)) {
      case Use::houses:
        addHouses(here, column, isView);
        break;
      case Use::tower: {
        const double turn = 0.25 * random_.below(4);
        place("tower", kit_.towers[random_.below(3)], here * turnedY(turn));
        addGreen(here, 24, 18, 6);
        break;
      }
      case Use::park:
        place("lawn", lawn_, here);
        addGreen(here, 30, 22, 16);
        break;
      case Use::market:
        for (const double x : {-22.0, 0.0, 22.0})
          place("market hall", kit_.hall, here * translation({x, 0, 0}));
        addGreen(here, 31, 21, 6);
        break;
    }
    addStreet(here);
  }

  // Trees and benches around the edge of a block.
  void addGreen(const glm::dmat4& here, double x, double z, int trees) {
    for (int i = 0; i < trees; ++i) {
      const int pair = i / 2;
      const double along = 4 * (pair + 0.5) / trees - 1, side = i % 2 == 0 ? 1 : -1;
      const double in = random_.range(0.75, 1.0), size = random_.range(0.9, 1.3);
      addTree(here * translation({x * along, 0, side * z * in}), size);
      if (i % 3 == 0)
        place("bench", kit_.bench,
              here * translation({x * along + 3, 0, side * (z + 1.5)}) * turnedY(side > 0 ? 0 : 0.5));
    }
  }

  void addTree(const glm::dmat4& where, double size) {
    const double turn = random_.unit();
    place("tree", kit_.trees[random_.below(4)], where * turnedY(turn) * scaling(glm::dvec3(size)));
  }

  void addHouses(const glm::dmat4& here, int column, bool isView) {
    // Towards the avenue they are higher.
    constexpr std::array<std::size_t, kColumns> kLowest{5, 2, 0};
    constexpr std::uint32_t kKinds = 6;
    const double x = kBlock.x - kLotDepth / 2, z = kBlock.y - kLotDepth / 2;
    struct Lot {
      double x, z, turn;
      bool isCorner;
    };
    const std::array<Lot, 8> lots{{{-kLotWidth, z, 0, true},
                                   {0, z, 0, false},
                                   {kLotWidth, z, 0, true},
                                   {x, 0, 0.25, false},
                                   {kLotWidth, -z, 0.5, true},
                                   {0, -z, 0.5, false},
                                   {-kLotWidth, -z, 0.5, true},
                                   {-x, 0, 0.75, false}}};
    const std::size_t lowest = kLowest[static_cast<std::size_t>(column)];
    for (const Lot& lot : lots) {
      const bool isViewLot = isView && lot.turn == 0.75;
      std::size_t kind = lowest + random_.below(kKinds);
      const bool isEmpty = random_.unit() < 0.06;
      if (isViewLot) kind = kViewTenement;
      const glm::dmat4 where = here * translation({lot.x, 0, lot.z}) * turnedY(lot.turn);
      if (isEmpty && !isViewLot) {
        addTree(where, random_.range(0.9, 1.2));
        continue;
      }
      const TenementMesh& mesh = kit_.tenements[kind];
      place("tenement", lot.isCorner ? mesh.corner : mesh.row, where);
      if (isViewLot) {
        addViewRoof(where * translation({0, mesh.height, 0}));
      } else {
        addRoof(where, mesh);
      }
    }
    const double yardX = random_.range(-12, 12), yardZ = random_.range(-5, 5);
    addTree(here * translation({yardX, 0, yardZ}), random_.range(1.0, 1.4));
  }

  void addRoof(const glm::dmat4& house, const TenementMesh& mesh) {
    if (!mesh.isFlat) {
      if (random_.unit() < 0.4)
        place("antennas", kit_.antennas, house * translation({-4, mesh.height + 3.1, 0}));
      return;
    }
    const std::uint32_t first = random_.below(4);
    for (std::uint32_t i = 0; i < 3; ++i) {
      const double x = -7 + 6.0 * i + random_.range(-1, 1), z = random_.range(-3, 3);
      const double turn = 0.25 * random_.below(4);
      place("roof furniture", kit_.roofs[(first + i) % 4],
            house * translation({x, mesh.height, z}) * turnedY(turn));
    }
  }

  // Where the views "roof" and "gap" stand: the same in every city.
  void addViewRoof(const glm::dmat4& roof) {
    place("water tank", kit_.roofs[0], roof * translation({-5, 0, -1}));
    place("vents", kit_.roofs[1], roof * translation({1, 0, 2.5}));
    place("lift house", kit_.roofs[2], roof * translation({-8.4, 0, -4.5}));
    place("antennas", kit_.antennas, roof * translation({-8.5, 0, 5.4}) * turnedY(0.1));
  }

  // Lamps, trees, benches and parked cars along the block's two long sides.
  void addStreet(const glm::dmat4& here) {
    for (const double turn : {0.0, 0.5}) {
      const glm::dmat4 side = here * turnedY(turn) * translation({0, 0, kBlock.y});
      for (const double x : {-30.0, 0.0, 30.0}) place("lamp", kit_.lamp, side * translation({x, 0, 3.4}));
      if (random_.unit() < 0.35)
        for (const double x : {-15.0, 15.0})
          addTree(side * translation({x, 0, 2.9}), random_.range(0.6, 0.85));
      if (random_.unit() < 0.4) place("bollards", kit_.bollards, side * translation({-7.5, 0, 3.6}));
      if (random_.unit() < 0.4) place("bench", kit_.bench, side * translation({8, 0, 2.4}));
      for (int slot = -4; slot <= 4; ++slot) {
        const double x = 6.2 * slot + random_.range(-0.4, 0.4);
        const bool isTurned = random_.unit() < 0.3, isThere = random_.unit() < 0.3;
        const std::uint32_t kind = random_.below(4);
        if (isThere)
          place("vehicle", kit_.vehicles[kind],
                side * translation({x, -kKerb, kPavement + 1.3}) * turnedY(isTurned ? 0.5 : 0));
      }
    }
  }

  void addAvenue() {
    constexpr double kSpacing = 17.5;
    for (int i = -28; i <= 28; ++i) {
      const double z = kSpacing * i;
      const bool isCrossing = (i % 4 + 4) % 4 == 2;
      if (isCrossing) {
        for (const double side : {-1.0, 1.0})
          place("traffic light", kit_.trafficLight,
                translation({side * (kRoad + 0.6), kKerb, z + side * 7}) * turnedY(side > 0 ? 0.75 : 0.25));
        continue;
      }
      addTree(translation({0, 0, z}), random_.range(0.8, 1.05));
      for (const double side : {-1.0, 1.0}) {
        place("lamp", kit_.lamp,
              translation({side * (kRoad + 0.6), kKerb, z + 5}) * turnedY(side > 0 ? 0.75 : 0.25));
        const double spot = random_.unit();
        if (spot < 0.3)
          place("shelter", kit_.shelter,
                translation({side * (kRoad + 1.2), kKerb, z}) * turnedY(side > 0 ? 0.75 : 0.25));
        if (spot > 0.6)
          place("bench", kit_.bench,
                translation({side * (kRoad + 2.2), kKerb, z}) * turnedY(side > 0 ? 0.75 : 0.25));
      }
      place("wire", kit_.wire, translation({0, 8.5, z + 9}));
      for (const double lane : {-12.2, -5.6, 5.6, 12.2}) {
        const double at = z + random_.range(-5, 5);
        const bool isThere = random_.unit() < 0.33;
        const std::uint32_t kind = random_.below(4);
        // They drive on the right.
        if (isThere)
          place("vehicle", kit_.vehicles[kind], translation({lane, 0, at}) * turnedY(lane > 0 ? 0.25 : 0.75));
      }
    }
    place("planter", kit_.planter, translation(kSapling));
    place("sapling", kit_.trees[0], translation(kSapling + glm::dvec3(0, 0.5, 0)) * scaling(glm::dvec3(0.3)));
  }

  SceneBuilder& builder_;
  Random random_;
  CityKit kit_;
  std::uint32_t pavement_ = 0, lawn_ = 0;
};

void makeCity(SceneBuilder& builder, const Values& values) {
  City city(builder, values[0]);
  city.build();

  const double roof = city.viewRoof(), wall = kRoad + kPavement;
  builder.addView(view("main", {7, 64, 400}, {-9, 2, 150}, 55));
  builder.addView(view("avenue", {6, 1.7, 455}, {-4, 12, -300}, 55));
  builder.addView(view("corner", {kRoad + 1, 1.8, 47}, {-9, 7, 12}, 65));
  builder.addView(view("roof", {wall + 10, roof + 1.7, 9.5}, {wall + 2.5, roof + 0.4, -20}, 60));
  builder.addView(view("gap", {wall + 0.9, roof + 1.7, -6.2}, {-12, 4, -75}, 55));
  builder.addLight(sun("sun", 50, 0.08));
  builder.addLight(sun("low", 5, 0.257));
  builder.addLight(sun("noon", 80, 0.15));
  builder.addLight(spot("spot", {-12, 40, 70}, {12, 0, 30}, 70));
  // A fifth of a degree a frame.
  builder.addPath(
      {"pan",
       {view("", {0, 24, 330}, {-25, 4, 30}, 50).view, view("", {0, 24, 330}, {25, 4, 30}, 50).view},
       48});
  builder.addPath({"walk",
                   {view("", {kRoad + 3.2, 1.8, 120}, {kRoad, 3, 60}, 60).view,
                    view("", {kRoad + 3.2, 1.8, 60}, {kRoad - 4, 4, 0}, 60).view,
                    view("", {kRoad + 3.2, 1.8, 15}, {-kRoad, 6, -30}, 60).view},
                   240});
  // A slow turn, in which the sapling's outer leaves come into the picture, nearer than anything else.
  const auto turned = [](double turns) {
    const glm::dvec3 eye = kSapling + glm::dvec3(-1.2, 1.5, 0.9);
    return view("", eye, eye + 20.0 * glm::dvec3(cosTurns(turns), -0.2, sinTurns(turns)), 50).view;
  };
  builder.addPath({"near-leaf", {turned(0.12), turned(0.06)}, 48});
}

}  // namespace

const Row kCity{"city", "blocks of houses and towers along an avenue, from a leaf to a kilometre away",
                kParameters, makeCity};

}  // namespace sundial::builtin
