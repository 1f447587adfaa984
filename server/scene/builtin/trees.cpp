// A wood: a few kinds of trees, instanced with small tight bounds over gently rolling ground.
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/builtin/builtin.h"
#include "scene/builtin/leaf_texture.h"
#include "scene/builtin/random.h"
#include "scene/builtin/shapes.h"
#include "scene/builtin/tree_parts.h"

namespace sundial::builtin {

namespace {

constexpr double kHalf = 100;      // the ground reaches this far each way
constexpr unsigned kCells = 60;    // of the ground, each way
constexpr std::size_t kKinds = 5;  // the last two are conifers

constexpr std::array<Parameter, 2> kParameters{
    {{"count", 1, 20000, 500, "how many trees"}, {"seed", 0, 4294967295, 1, "which wood"}}};

double groundHeight(double x, double z) {
  return 1.6 * sinTurns(x / 73 + 0.1) * cosTurns(z / 91) + 0.9 * sinTurns((x + 1.7 * z) / 57 + 0.3) +
         0.25 * sinTurns((2.1 * x - z) / 31);
}

void addGround(SceneBuilder& builder) {
  Shape ground;
  ground.surface(kCells, kCells, [](double u, double v) {
    const double x = kHalf * (2 * u - 1), z = kHalf * (1 - 2 * v);
    return glm::dvec3(x, groundHeight(x, z), z);
  });
  std::vector<Primitive> primitives;
  primitives.push_back(std::move(ground).take(addColour(builder, "grass", {0.2f, 0.23f, 0.09f}, true)));
  builder.addInstance("ground", builder.addMesh("ground", std::move(primitives)), glm::dmat4(1));
}

void makeTrees(SceneBuilder& builder, const Values& values) {
  const auto count = static_cast<unsigned>(values[0]);
  Random random(values[1]);
  addGround(builder);

  const std::uint32_t bark = addColour(builder, "bark", {0.15f, 0.1f, 0.065f});
  const std::uint32_t twigs = addLeafMaterial(builder, "twigs", twigTexture(), {0.95f, 1.0f, 0.85f});
  const std::uint32_t needles = addColour(builder, "needles", {0.06f, 0.13f, 0.06f}, true);
  std::array<std::uint32_t, kKinds> kinds;
  for (std::size_t k = 0; k < kKinds; ++k) {
    const bool isConifer = k >= 3;
    Tree tree = isConifer ? conifer(random) : broadleaf({}, random);
    std::vector<Primitive> primitives;
    primitives.push_back(std::move(tree.wood).take(bark));
    primitives.push_back(std::move(tree.leaves).take(isConifer ? needles : twigs));
    kinds[k] = builder.addMesh(isConifer ? "conifer" : "broadleaf", std::move(primitives));
  }

  // One tree a cell of a square lattice, anywhere in its middle: never two in one place.
  const auto side = static_cast<unsigned>(std::ceil(std::sqrt(static_cast<double>(count))));
  const double cell = 2 * kHalf / side;
  for (unsigned i = 0; i < count; ++i) {
    // Spread over the whole lattice when there are fewer trees than cells.
    const auto slot = static_cast<unsigned>(std::uint64_t{i} * side * side / count);
    const unsigned column = slot % side, row = slot / side;
    const double x = (column + random.range(0.15, 0.85)) * cell - kHalf;
    const double z = (row + random.range(0.15, 0.85)) * cell - kHalf;
    const std::size_t kind = random.below(kKinds);
    const double size = random.range(0.8, 1.25);
    builder.addInstance("tree", kinds[kind],
                        translation({x, groundHeight(x, z), z}) * turnedY(random.unit()) *
                            scaling({size, size * random.range(0.9, 1.15), size}));
  }

  const auto above = [](double x, double height, double z) {
    return glm::dvec3(x, groundHeight(x, z) + height, z);
  };
  builder.addView(view("main", above(-38, 16, 52), above(6, 2, -8), 50));
  builder.addView(view("walk", above(-20, 1.7, 40), above(5, 3, 0), 60));
  builder.addView(view("above", {-120, 95, 120}, {0, 0, 0}, 50));
  builder.addView(view("canopy", above(10, 11, 25), above(-10, 3, -15), 55));
  builder.addLight(sun("sun", 50, 0.12));
  builder.addLight(sun("low", 5, 0.04));
  builder.addLight(sun("noon", 80, 0.2));
  builder.addLight(spot("spot", {0, 32, 20}, {0, 0, 0}, 80));
  builder.addPath({"flight",
                   {view("", above(-80, 14, 70), above(-30, 3, 30), 55).view,
                    view("", above(-20, 12, 30), above(20, 3, 0), 55).view,
                    view("", above(40, 14, 0), above(60, 3, -50), 55).view},
                   240});
}

}  // namespace

const Row kTrees{"trees", "a wood of instanced trees on rolling ground", kParameters, makeTrees};

}  // namespace sundial::builtin
