#include "scene/builtin/city_kit.h"

#include "scene/builtin/city_street.h"
#include "scene/builtin/leaf_texture.h"
#include "scene/builtin/tree_parts.h"

namespace sundial::builtin {

namespace {

constexpr glm::vec3 kGlass{0.05f, 0.08f, 0.11f}, kSandstone{0.5f, 0.42f, 0.3f}, kBrick{0.3f, 0.12f, 0.07f},
    kCream{0.58f, 0.53f, 0.42f}, kGrey{0.36f, 0.36f, 0.35f}, kRose{0.48f, 0.3f, 0.24f},
    kWhite{0.62f, 0.61f, 0.58f}, kOchre{0.5f, 0.36f, 0.16f};

constexpr Window kSash{
    .width = 1.25, .height = 2.0, .sill = 0.7, .recess = 0.22, .across = 2, .up = 1, .ledge = 0.18};
constexpr Window kFrench{.width = 1.4, .height = 2.4, .sill = 0.25, .recess = 0.25, .across = 2, .up = 1};
constexpr Window kRibbon{.width = 2.9, .height = 1.6, .sill = 0.9, .recess = 0.12, .across = 3, .up = 1};
constexpr Window kShuttered{.width = 1.1,
                            .height = 1.9,
                            .sill = 0.75,
                            .recess = 0.2,
                            .across = 2,
                            .up = 1,
                            .ledge = 0.15,
                            .shutters = 0.5};

constexpr std::array<Tenement, 11> kTenements{{
    {2, 7, kShuttered, false, false, Roof::mansard, {kCream, kSandstone, kGlass}},
    {3, 6, kRibbon, false, false, Roof::flat, {kGrey, kWhite, kGlass}},
    {3, 8, kSash, false, true, Roof::mansard, {kBrick, kSandstone, kGlass}},
    {4, 7, kFrench, true, false, Roof::flat, {kRose, kCream, kGlass}},
    {4, 7, kShuttered, false, true, Roof::mansard, {kOchre, kCream, kGlass}},
    {5, 8, kSash, false, true, Roof::flat, {kBrick, kCream, kGlass}},
    {5, 7, kFrench, true, true, Roof::mansard, {kSandstone, kCream, kGlass}},
    {6, 6, kRibbon, false, false, Roof::flat, {kWhite, kGrey, kGlass}},
    {6, 8, kSash, false, true, Roof::mansard, {kCream, kSandstone, kGlass}},
    {7, 7, kFrench, true, true, Roof::flat, {kSandstone, kCream, kGlass}},
    {9, 6, kRibbon, false, false, Roof::flat, {kGrey, kRose, kGlass}},
}};

std::uint32_t addTree(SceneBuilder& builder, std::uint32_t bark, std::uint32_t leaf, Random& random) {
  Tree tree = broadleaf({.boughs = 8, .cards = 11, .card = 1.35}, random);
  std::vector<Primitive> primitives;
  primitives.push_back(std::move(tree.wood).take(bark));
  primitives.push_back(std::move(tree.leaves).take(leaf));
  return builder.addMesh("tree", std::move(primitives));
}

}  // namespace

std::uint32_t addPainted(SceneBuilder& builder, std::string name, Shape shape, std::uint32_t paint) {
  std::vector<Primitive> primitives;
  primitives.push_back(std::move(shape).take(paint));
  return builder.addMesh(std::move(name), std::move(primitives));
}

CityKit addCityKit(SceneBuilder& builder, Random& random) {
  CityKit kit{};
  kit.paint = addColour(builder, "painted", glm::vec3(1), true);
  const auto add = [&](std::string name, Shape shape) {
    return addPainted(builder, std::move(name), std::move(shape), kit.paint);
  };
  for (std::size_t i = 0; i < kTenements.size(); ++i) {
    const Tenement& house = kTenements[i];
    kit.tenements[i] = {.row = add("tenement", tenement(house, false)),
                        .corner = add("corner tenement", tenement(house, true)),
                        .height = tenementHeight(house),
                        .isFlat = house.roof == Roof::flat};
  }
  constexpr std::array<Tier, 3> kStepped{{{13, 12}, {10.5, 9}, {7.5, 6}}};
  constexpr std::array<Tier, 2> kSlab{{{14, 3}, {11, 23}}};
  constexpr std::array<Tier, 2> kLow{{{13.5, 10}, {9, 4}}};
  kit.towers = {add("tower", tower(kStepped, {kSandstone, kCream, kGlass})),
                add("tower", tower(kSlab, {kGrey, kWhite, kGlass})),
                add("tower", tower(kLow, {kRose, kGrey, kGlass}))};

  const std::uint32_t bark = addColour(builder, "bark", {0.15f, 0.1f, 0.065f});
  const std::uint32_t leaf = addLeafMaterial(builder, "twigs", twigTexture(), {0.55f, 0.7f, 0.5f});
  for (std::uint32_t& tree : kit.trees) tree = addTree(builder, bark, leaf, random);
  kit.vehicles = {add("car", car({0.45f, 0.04f, 0.03f})), add("car", car({0.5f, 0.52f, 0.54f})),
                  add("car", car({0.05f, 0.1f, 0.22f})), add("van", van({0.6f, 0.6f, 0.57f}))};
  kit.antennas = add("antennas", antennas());
  kit.roofs = {add("water tank", waterTank()), add("vents", vents()), add("lift house", liftHouse()),
               kit.antennas};
  kit.hall = add("market hall", marketHall());
  kit.lamp = add("lamp", streetLamp());
  kit.trafficLight = add("traffic light", trafficLight());
  kit.bench = add("bench", bench());
  kit.bollards = add("bollards", bollards());
  kit.shelter = add("shelter", shelter());
  kit.planter = add("planter", planter());
  kit.wire = add("wire", wire(kWireSpan, 0.7));
  return kit;
}

}  // namespace sundial::builtin
