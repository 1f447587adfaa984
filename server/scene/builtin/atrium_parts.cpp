#include "scene/builtin/atrium_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sundial::builtin {

namespace {

// A half-round moulding (torus) as part of a lathe's profile, from `bottom` upwards.
void addTorus(std::vector<glm::dvec2>& profile, double radius, double bottom, double height, int steps) {
  for (int i = 0; i <= steps; ++i) {
    const double turn = 0.5 * i / steps - 0.25;
    profile.emplace_back(radius + 0.5 * height * cosTurns(turn),
                         bottom + 0.5 * height * (1 + sinTurns(turn)));
  }
}

}  // namespace

Shape column(double height, double radius, unsigned flutes) {
  const double baseHeight = 0.9 * radius, capitalHeight = 1.5 * radius;
  Shape shape;

  // Plinth and base.
  const double plinth = 0.35 * baseHeight;
  shape.box({-1.45 * radius, 0, -1.45 * radius}, {1.45 * radius, plinth, 1.45 * radius});
  std::vector<glm::dvec2> base;
  addTorus(base, 1.2 * radius, plinth, 0.32 * baseHeight, 4);
  addTorus(base, 1.06 * radius, plinth + 0.4 * baseHeight, 0.22 * baseHeight, 3);
  base.emplace_back(radius, baseHeight);
  shape.lathe(base, 24);

  // The shaft swells a little and narrows upwards; its flutes end in round hollows.
  const double shaft = height - baseHeight - capitalHeight;
  shape.surface(flutes * 4, 6, [&](double u, double v) {
    const double turn = u < 1 ? u : 0;
    const double taper = radius * (1 - 0.14 * v * v);
    const double ends = std::min(1.0, 12 * std::min(v, 1 - v));
    const double hollow = 0.5 - 0.5 * cosTurns(turn * flutes);
    const double r = taper * (1 - 0.1 * ends * std::sqrt(hollow));
    return glm::dvec3(r * sinTurns(turn), baseHeight + v * shaft, r * cosTurns(turn));
  });

  // Capital: a ring, a bell with leaves hinted by lobes, an abacus.
  const double neck = 0.86 * radius, bottom = height - capitalHeight;
  std::vector<glm::dvec2> ring;
  addTorus(ring, neck, bottom, 0.16 * capitalHeight, 4);
  shape.lathe(ring, 24);
  shape.surface(40, 6, [&](double u, double v) {
    const double turn = u < 1 ? u : 0;
    const double lobes = 0.07 * radius * v * (1 + cosTurns(8 * turn + (v > 0.5 ? 0.5 : 0)));
    const double r = neck + (1.28 * radius - neck) * v * v + lobes;
    return glm::dvec3(r * sinTurns(turn), bottom + (0.14 + 0.66 * v) * capitalHeight, r * cosTurns(turn));
  });
  shape.box({-1.42 * radius, height - 0.22 * capitalHeight, -1.42 * radius},
            {1.42 * radius, height, 1.42 * radius});
  return shape;
}

Shape archBay(const ArchSize& size) {
  const auto [width, height, thickness, radius] = size;
  const double half = width / 2, depth = thickness / 2;
  constexpr unsigned kSegments = 24;
  Shape shape;

  // Spandrels: from the arch up to the top, on both faces; and the piers beside it.
  for (const double side : {1.0, -1.0}) {
    shape.surface(kSegments, 1, [&](double u, double v) {
      const double turn = side > 0 ? 0.5 - 0.5 * u : 0.5 * u;
      const double x = radius * cosTurns(turn), y = std::max(radius * sinTurns(turn), 0.0);
      return glm::dvec3(x, y + (height - y) * v, side * depth);
    });
    const auto pier = [&](double from, double to) {
      if (side > 0)
        shape.quad({from, 0, depth}, {to, 0, depth}, {to, height, depth}, {from, height, depth});
      else
        shape.quad({to, 0, -depth}, {from, 0, -depth}, {from, height, -depth}, {to, height, -depth});
    };
    pier(-half, -radius);
    pier(radius, half);

    // Archivolt: moulding that stands proud of the wall.
    constexpr std::array<glm::dvec2, 6> kProfile{
        {{0, 0}, {0, 0.05}, {0.05, 0.07}, {0.1, 0.05}, {0.14, 0.08}, {0.2, 0}}};
    shape.surface(kSegments, kProfile.size() - 1, [&](double u, double v) {
      const glm::dvec2 p = kProfile[static_cast<std::size_t>(std::lround(v * (kProfile.size() - 1)))];
      const double turn = side > 0 ? 0.5 - 0.5 * u : 0.5 * u;
      const double r = radius + p.x;
      return glm::dvec3(r * cosTurns(turn), std::max(r * sinTurns(turn), 0.0), side * (depth + p.y));
    });
    shape.box({-0.09, radius - 0.04, side > 0 ? depth : -depth - 0.14},
              {0.09, radius + 0.3, side > 0 ? depth + 0.14 : -depth});  // keystone
  }
  // The arch's underside and the piers'.
  shape.surface(kSegments, 2, [&](double u, double v) {
    const double turn = 0.5 * u;
    return glm::dvec3(radius * cosTurns(turn), std::max(radius * sinTurns(turn), 0.0), depth - thickness * v);
  });
  shape.quad({-half, 0, -depth}, {-radius, 0, -depth}, {-radius, 0, depth}, {-half, 0, depth});
  shape.quad({radius, 0, -depth}, {half, 0, -depth}, {half, 0, depth}, {radius, 0, depth});
  shape.quad({-half, height, depth}, {half, height, depth}, {half, height, -depth}, {-half, height, -depth});
  return shape;
}

Shape balustrade(double width, unsigned balusters) {
  constexpr std::array<glm::dvec2, 12> kProfile{{{0.055, 0.12},
                                                 {0.055, 0.16},
                                                 {0.035, 0.19},
                                                 {0.05, 0.24},
                                                 {0.062, 0.31},
                                                 {0.055, 0.39},
                                                 {0.034, 0.5},
                                                 {0.028, 0.6},
                                                 {0.04, 0.66},
                                                 {0.03, 0.7},
                                                 {0.05, 0.74},
                                                 {0.05, 0.78}}};
  Shape baluster;
  baluster.lathe(kProfile, 8);
  Shape shape;
  shape.box({-width / 2, 0, -0.09}, {width / 2, 0.12, 0.09});
  shape.box({-width / 2, 0.78, -0.11}, {width / 2, 0.9, 0.11});
  for (unsigned i = 0; i < balusters; ++i)
    shape.append(baluster, translation({width * ((i + 0.5) / balusters - 0.5), 0, 0}));
  return shape;
}

Shape curtain(double width, double height, Random& random) {
  const double phase = random.unit(), folds = random.range(4.5, 6.5), sway = random.range(-0.12, 0.12);
  Shape shape;
  shape.surface(36, 40, [&](double u, double v) {
    const double down = 1 - v;
    const double fold = sinTurns(folds * u + phase + 0.15 * sinTurns(down * 0.7)) +
                        0.35 * sinTurns(2.3 * folds * u + 2 * phase + 0.4 * down);
    const double gather = 1 - 0.12 * sinTurns(0.5 * down);
    return glm::dvec3((u - 0.5) * width * gather, -down * height + 0.03 * sinTurns(folds * u + phase) * down,
                      0.07 * (0.4 + 0.6 * down) * fold + sway * down * down);
  });
  return shape;
}

Lamp hangingLamp(unsigned links) {
  constexpr double kLink = 0.12;
  Shape link;
  link.surface(12, 6, [&](double u, double v) {
    const double around = u < 1 ? u : 0, turn = v < 1 ? v : 0;
    const double r = 0.008 * cosTurns(turn);
    return glm::dvec3((0.035 + r) * cosTurns(around), (0.07 + r) * sinTurns(around), -0.008 * sinTurns(turn));
  });
  Lamp lamp;
  for (unsigned i = 0; i < links; ++i)
    lamp.metal.append(link, translation({0, -kLink * (i + 0.5), 0}) * turnedY(i % 2 == 0 ? 0 : 0.25));

  // Lantern: a bowl of glass between two rings and four bars.
  const double top = -kLink * links;
  const std::array<glm::dvec2, 6> cap{
      {{0.2, top - 0.16}, {0.21, top - 0.13}, {0.12, top - 0.08}, {0.05, top - 0.05}, {0.03, top}, {0, top}}};
  lamp.metal.lathe(cap, 20);
  const std::array<glm::dvec2, 4> foot{
      {{0, top - 0.62}, {0.07, top - 0.6}, {0.09, top - 0.56}, {0.07, top - 0.54}}};
  lamp.metal.lathe(foot, 20);
  for (int i = 0; i < 4; ++i) {
    const double turn = 0.25 * i + 0.125;
    const glm::dvec3 side(sinTurns(turn), 0, cosTurns(turn));
    const std::array<glm::dvec3, 4> bar{
        0.19 * side + glm::dvec3(0, top - 0.15, 0), 0.22 * side + glm::dvec3(0, top - 0.32, 0),
        0.16 * side + glm::dvec3(0, top - 0.48, 0), 0.07 * side + glm::dvec3(0, top - 0.58, 0)};
    constexpr std::array<double, 4> kRadii{0.01, 0.01, 0.01, 0.01};
    lamp.metal.tube(bar, kRadii, 6);
  }
  const std::array<glm::dvec2, 6> bowl{{{0.05, top - 0.54},
                                        {0.13, top - 0.47},
                                        {0.18, top - 0.36},
                                        {0.19, top - 0.27},
                                        {0.17, top - 0.2},
                                        {0.16, top - 0.16}}};
  lamp.glass.lathe(bowl, 20);
  return lamp;
}

Plant plant(unsigned leaves, Random& random) {
  Plant result;
  constexpr std::array<glm::dvec2, 10> kPot{{{0, 0},
                                             {0.2, 0},
                                             {0.24, 0.08},
                                             {0.31, 0.3},
                                             {0.34, 0.48},
                                             {0.37, 0.5},
                                             {0.37, 0.58},
                                             {0.32, 0.58},
                                             {0.31, 0.52},
                                             {0, 0.5}}};
  result.pot.lathe(kPot, 28);
  for (unsigned i = 0; i < leaves; ++i) {
    // Blades that rise and bend outwards.
    const double turn = random.unit(), reach = random.range(0.35, 0.85), rise = random.range(0.5, 1.35);
    const double width = random.range(0.16, 0.24), droop = random.range(0.1, 0.6);
    const glm::dvec3 out(sinTurns(turn), 0, cosTurns(turn)), side(cosTurns(turn), 0, -sinTurns(turn));
    result.leaves.surface(2, 6, [&](double u, double v) {
      const double spread = reach * v * (0.35 + 0.65 * v);
      const double height = 0.5 + rise * (v - droop * v * v * v);
      const double crease = 0.18 * width * std::abs(2 * u - 1);
      return out * spread + side * (width * (u - 0.5)) + glm::dvec3(0, height + crease, 0);
    });
  }
  return result;
}

Shape cornice(const glm::dvec2& half, std::span<const glm::dvec2> profile) {
  Shape shape;
  constexpr std::array<glm::dvec2, 4> kCorners{{{-1, 1}, {-1, -1}, {1, -1}, {1, 1}}};
  const auto last = static_cast<double>(profile.size() - 1);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 from = kCorners[i], to = kCorners[(i + 1) % 4];
    shape.surface(1, static_cast<unsigned>(profile.size() - 1), [&](double u, double v) {
      const glm::dvec2 p = profile[static_cast<std::size_t>(std::lround(v * last))];
      const glm::dvec2 corner = (u < 0.5 ? from : to) * (half - p.x);
      return glm::dvec3(corner.x, p.y, corner.y);
    });
  }
  return shape;
}

}  // namespace sundial::builtin
