#include "scene/builtin/tree_parts.h"

#include <array>
#include <cmath>

namespace sundial::builtin {

namespace {

glm::dvec3 onCircle(double turn) { return {sinTurns(turn), 0, cosTurns(turn)}; }

// A flat card from `root` along `along`, drooping, its width along `side`.
void addCard(Shape& shape, const glm::dvec3& root, const glm::dvec3& along, const glm::dvec3& side,
             double length, double width, double droop) {
  shape.surface(1, 2, [&](double u, double v) {
    return root + along * (length * v) + side * (width * (u - 0.5)) -
           glm::dvec3(0, droop * length * v * v, 0);
  });
}

}  // namespace

Tree broadleaf(const Broadleaf& kind, Random& random) {
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
  for (int b = 0; b < kind.boughs; ++b) {
    const double t = 0.35 + 0.62 * b / (kind.boughs - 1);
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
    for (int c = 0; c < kind.cards; ++c) {
      const glm::dvec3 at = along(0.3 + 0.75 * random.unit());
      const glm::dvec3 twig =
          glm::normalize(onCircle(random.unit()) + 0.5 * out + glm::dvec3(0, random.range(-0.35, 0.9), 0));
      const glm::dvec3 side =
          glm::normalize(glm::cross(twig, onCircle(random.unit()) + glm::dvec3(0, 0.4, 0)));
      const double width = kind.card * random.range(0.7, 1.0), length = kind.card * random.range(0.75, 1.15);
      addCard(tree.leaves, at, twig, side, length, width, 0.15);
    }
  }
  return tree;
}

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

}  // namespace sundial::builtin
