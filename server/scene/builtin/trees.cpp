// A wood: a few kinds of trees, instanced with small tight bounds over gently rolling ground.
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/builtin/builtin.h"
#include "scene/builtin/leaf_texture.h"
#include "scene/builtin/random.h"
#include "scene/builtin/shapes.h"

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

glm::dvec3 onCircle(double turn) { return {sinTurns(turn), 0, cosTurns(turn)}; }

struct Tree {
  Shape wood, leaves;
};

// A flat card from `root` along `along`, drooping, its width along `side`.
void addCard(Shape& shape, const glm::dvec3& root, const glm::dvec3& along, const glm::dvec3& side,
             double length, double width, double droop) {
  shape.surface(1, 2, [&](double u, double v) {
    return root + along * (length * v) + side * (width * (u - 0.5)) -
           glm::dvec3(0, droop * length * v * v, 0);
  });
}

// A trunk that forks into boughs, each with twigs' cards around its outer half.
Tree broadleaf(Random& random) {
  constexpr int kBoughs = 13, kCards = 28;
  Tree tree;
  const double height = random.range(6, 8.5), lean = random.range(-0.5, 0.5);
  std::array<glm::dvec3, 8> trunk;
  std::array<double, 8> radii;
  for (std::size_t i = 0; i < trunk.size(); ++i) {
    const double t = static_cast<double>(i) / (trunk.size() - 1);
    trunk[i] = {lean * t * t, height * 0.8 * t - 0.3, 0.15 * sinTurns(t)};
    radii[i] = 0.26 * (1 - 0.85 * t) + 0.12 * (1 - t) * (1 - t) * (1 - t) * (1 - t);
  }
  tree.wood.tube(trunk, radii, 9);
  for (int b = 0; b < kBoughs; ++b) {
    const double t = 0.35 + 0.62 * b / (kBoughs - 1);
    const double turn = b * 0.381966 + random.range(-0.04, 0.04);
    const double reach = (1 - 0.55 * t) * random.range(2.7, 3.7), rise = random.range(0.25, 0.65) + 0.6 * t;
    const glm::dvec3 root(lean * t * t, height * 0.8 * t - 0.3, 0.15 * sinTurns(t));
    const glm::dvec3 out = onCircle(turn);
    const auto along = [&](double s) {
      return root + out * (reach * s) + glm::dvec3(0, reach * rise * s * (1 - 0.35 * s), 0);
    };
    std::array<glm::dvec3, 5> bough;
    std::array<double, 5> thickness;
    for (std::size_t i = 0; i < bough.size(); ++i) {
      const double s = static_cast<double>(i) / (bough.size() - 1);
      bough[i] = along(s);
      thickness[i] = 0.09 * (1 - 0.5 * t) * (1 - 0.85 * s);
    }
    tree.wood.tube(bough, thickness, 5);
    for (int c = 0; c < kCards; ++c) {
      const glm::dvec3 at = along(0.3 + 0.75 * random.unit());
      const glm::dvec3 twig =
          glm::normalize(onCircle(random.unit()) + 0.5 * out + glm::dvec3(0, random.range(-0.35, 0.9), 0));
      const glm::dvec3 side =
          glm::normalize(glm::cross(twig, onCircle(random.unit()) + glm::dvec3(0, 0.4, 0)));
      addCard(tree.leaves, at, twig, side, random.range(0.75, 1.15), random.range(0.7, 1.0), 0.15);
    }
  }
  return tree;
}

// Whorls of drooping fronds up a straight trunk.
Tree conifer(Random& random) {
  constexpr int kWhorls = 19;
  Tree tree;
  const double height = random.range(9, 12);
  const std::array<glm::dvec3, 4> trunk{
      {{0, -0.3, 0}, {0, height * 0.3, 0}, {0.02, height * 0.7, 0.02}, {0, height, 0}}};
  constexpr std::array<double, 4> kRadii{0.24, 0.17, 0.08, 0.01};
  tree.wood.tube(trunk, kRadii, 9);
  for (int w = 0; w < kWhorls; ++w) {
    const double t = static_cast<double>(w) / (kWhorls - 1);
    const double reach = 0.25 + (1 - t) * random.range(1.9, 2.3);
    const int fronds = 7 + (kWhorls - w) / 4;
    for (int f = 0; f < fronds; ++f) {
      const double turn = (f + random.range(-0.25, 0.25)) / fronds + 0.17 * w;
      const glm::dvec3 out = onCircle(turn), side = onCircle(turn + 0.25);
      const glm::dvec3 root(0, height * (0.12 + 0.87 * t * (1.12 - 0.12 * t)) + random.range(-0.1, 0.1), 0);
      const double length = reach * random.range(0.85, 1.1), width = 0.32 + 0.3 * length;
      // Two halves that fall off like a roof, pointed at the tip.
      tree.leaves.surface(2, 3, [&](double u, double v) {
        const double across = (u - 0.5) * width * (v < 0.4 ? 0.35 + 1.6 * v : 1.65 * (1 - v));
        const double fall = 0.28 * length * v * v + 0.5 * std::abs(across) - 0.18 * length * v;
        return root + out * (length * v) + side * across - glm::dvec3(0, fall, 0);
      });
    }
  }
  return tree;
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
    Tree tree = isConifer ? conifer(random) : broadleaf(random);
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
    const double x = (slot % side + random.range(0.15, 0.85)) * cell - kHalf;
    const double z = (slot / side + random.range(0.15, 0.85)) * cell - kHalf;
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
