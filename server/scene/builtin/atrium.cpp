// A courtyard of two storeys, 30 x 12 x 14 m: arcades of fluted columns around a court open to the sky, end
// walls with arched windows, curtains, lamps and plants. Stands in for Crytek's Sponza, which can't be
// shipped.
#include <array>

#include "scene/builtin/atrium_parts.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/leaf_texture.h"

namespace sundial::builtin {

namespace {

constexpr double kHalfX = 15, kHalfZ = 7, kTop = 12, kWall = 0.4;
constexpr double kBay = 2.5;           // from column to column
constexpr int kBaysX = 9, kBaysZ = 3;  // around the court
constexpr double kCourtX = kBay * kBaysX / 2, kCourtZ = kBay * kBaysZ / 2;
constexpr double kGallery = 5.4, kSlab = 0.2;  // upper floor, and how thick it is
constexpr double kEaves = 10.3, kDepth = 0.5;  // where the roof begins; depth of the arcades' walls

constexpr ArchSize kLowerArch{.width = kBay, .height = 1.8, .thickness = kDepth, .radius = 0.88};
constexpr ArchSize kUpperArch{.width = kBay, .height = 1.6, .thickness = kDepth, .radius = 0.95};
constexpr double kLowerColumn = kGallery - kSlab - kLowerArch.height, kUpperColumn = 2.7;
constexpr double kWindowBay = 2.8;
constexpr ArchSize kWindow{.width = kWindowBay, .height = 1.7, .thickness = kWall, .radius = 0.8};

struct Paints {
  std::uint32_t stone, wall, floor, inlay, roof, wood, metal, glass, pot, leaf;
  std::array<std::uint32_t, 3> cloth;
};

Paints addPaints(SceneBuilder& b) {
  return {.stone = addColour(b, "stone", {0.62f, 0.53f, 0.41f}),
          .wall = addColour(b, "plaster", {0.66f, 0.57f, 0.44f}),
          .floor = addColour(b, "floor", {0.45f, 0.4f, 0.34f}),
          .inlay = addColour(b, "inlay", {0.28f, 0.2f, 0.16f}),
          .roof = addColour(b, "roof tiles", {0.46f, 0.17f, 0.09f}, true),
          .wood = addColour(b, "wood", {0.17f, 0.09f, 0.045f}),
          .metal = addColour(b, "metal", {0.12f, 0.1f, 0.08f}),
          .glass = addColour(b, "lamp glass", {0.8f, 0.68f, 0.4f}, true),
          .pot = addColour(b, "terracotta", {0.5f, 0.22f, 0.12f}),
          .leaf = addLeafMaterial(b, "leaves", leafTexture(), {0.9f, 1.0f, 0.85f}),
          .cloth = {addColour(b, "red curtain", {0.5f, 0.035f, 0.03f}, true),
                    addColour(b, "green curtain", {0.05f, 0.22f, 0.07f}, true),
                    addColour(b, "blue curtain", {0.04f, 0.09f, 0.36f}, true)}};
}

std::uint32_t addMesh(SceneBuilder& builder, std::string name, Shape a, std::uint32_t materialA, Shape b,
                      std::uint32_t materialB) {
  std::vector<Primitive> primitives;
  primitives.push_back(std::move(a).take(materialA));
  primitives.push_back(std::move(b).take(materialB));
  return builder.addMesh(std::move(name), std::move(primitives));
}

// Calls place(transform) for each bay around the court, x along the bay and z towards the court.
template <class Place>
void eachBay(double y, Place place) {
  for (int i = 0; i < kBaysX; ++i) {
    const double x = kBay * (i + 0.5) - kCourtX;
    place(translation({x, y, -kCourtZ}));
    place(translation({-x, y, kCourtZ}) * turnedY(0.5));
  }
  for (int i = 0; i < kBaysZ; ++i) {
    const double z = kBay * (i + 0.5) - kCourtZ;
    place(translation({-kCourtX, y, -z}) * turnedY(0.25));
    place(translation({kCourtX, y, z}) * turnedY(0.75));
  }
}

// And for each column: at the left end of each bay.
template <class Place>
void eachColumn(double y, Place place) {
  eachBay(y, [&](const glm::dmat4& bay) {
    const glm::dvec4 end = bay * glm::dvec4(-kBay / 2, 0, 0, 1);
    place(translation(glm::dvec3(end)));
  });
}

void addArcades(SceneBuilder& builder, const Paints& paints) {
  const std::uint32_t lower = addMesh(builder, "lower column", column(kLowerColumn, 0.26, 20), paints.stone);
  const std::uint32_t upper = addMesh(builder, "upper column", column(kUpperColumn, 0.2, 16), paints.stone);
  const std::uint32_t lowerArch = addMesh(builder, "lower arch", archBay(kLowerArch), paints.wall);
  const std::uint32_t upperArch = addMesh(builder, "upper arch", archBay(kUpperArch), paints.wall);
  const std::uint32_t rail = addMesh(builder, "balustrade", balustrade(kBay - 0.5, 7), paints.stone);
  eachColumn(0, [&](const glm::dmat4& m) { builder.addInstance("lower column", lower, m); });
  eachColumn(kGallery, [&](const glm::dmat4& m) { builder.addInstance("upper column", upper, m); });
  eachBay(kLowerColumn, [&](const glm::dmat4& m) { builder.addInstance("lower arch", lowerArch, m); });
  eachBay(kGallery + kUpperColumn,
          [&](const glm::dmat4& m) { builder.addInstance("upper arch", upperArch, m); });
  eachBay(kGallery, [&](const glm::dmat4& m) { builder.addInstance("balustrade", rail, m); });
}

// A flat ring between the court and the outer walls.
void addRing(Shape& shape, double bottom, double top, double inset) {
  const double x = kCourtX - inset, z = kCourtZ - inset;
  shape.box({-kHalfX, bottom, z}, {kHalfX, top, kHalfZ});
  shape.box({-kHalfX, bottom, -kHalfZ}, {kHalfX, top, -z});
  shape.box({-kHalfX, bottom, -z}, {-x, top, z});
  shape.box({x, bottom, -z}, {kHalfX, top, z});
}

// Tiled floors, with a darker border around the court.
void addFloors(SceneBuilder& builder, const Paints& paints) {
  Shape tiles, inlay;
  inlay.box({-kHalfX, -0.3, -kHalfZ}, {kHalfX, -0.012, kHalfZ});
  constexpr double kJoint = 0.012, kBevel = 0.012;
  for (int j = -7; j < 7; ++j)
    for (int i = -15; i < 15; ++i) {
      const glm::dvec3 a(i + kJoint, -kBevel, j + kJoint), b(i + 1 - kJoint, 0, j + 1 - kJoint);
      const glm::dvec3 c(a.x + kBevel, 0, a.z + kBevel), d(b.x - kBevel, 0, b.z - kBevel);
      Shape& shape =
          (i == -12 || i == 11 || j == -5 || j == 4) && std::abs(i + 0.5) < 12 && std::abs(j + 0.5) < 5
              ? inlay
              : tiles;
      shape.quad({c.x, 0, d.z}, {d.x, 0, d.z}, {d.x, 0, c.z}, {c.x, 0, c.z});
      shape.quad({a.x, a.y, b.z}, {b.x, a.y, b.z}, {d.x, 0, d.z}, {c.x, 0, d.z});
      shape.quad({b.x, a.y, b.z}, {b.x, a.y, a.z}, {d.x, 0, c.z}, {d.x, 0, d.z});
      shape.quad({b.x, a.y, a.z}, {a.x, a.y, a.z}, {c.x, 0, c.z}, {d.x, 0, c.z});
      shape.quad({a.x, a.y, a.z}, {a.x, a.y, b.z}, {c.x, 0, d.z}, {c.x, 0, c.z});
    }
  addRing(tiles, kGallery - kSlab, kGallery, 0.3);
  builder.addInstance(
      "floor", addMesh(builder, "floor", std::move(tiles), paints.floor, std::move(inlay), paints.inlay),
      glm::dmat4(1));

  // Beams under the gallery and under the roof.
  Shape beams;
  for (int i = 0; i <= kBaysX; ++i) {
    const double x = kBay * i - kCourtX;
    for (const double y : {kGallery - kSlab, kEaves}) {
      beams.box({x - 0.1, y - 0.28, kCourtZ + kDepth / 2}, {x + 0.1, y, kHalfZ});
      beams.box({x - 0.1, y - 0.28, -kHalfZ}, {x + 0.1, y, -kCourtZ - kDepth / 2});
    }
  }
  builder.addInstance("beams", addMesh(builder, "beams", std::move(beams), paints.wood), glm::dmat4(1));
}

void addCornices(SceneBuilder& builder, const Paints& paints) {
  const glm::dvec2 face(kCourtX - kDepth / 2, kCourtZ - kDepth / 2);
  constexpr std::array<glm::dvec2, 7> kString{
      {{0, 0}, {0.06, 0.03}, {0.06, 0.08}, {0.12, 0.13}, {0.16, 0.15}, {0.16, 0.2}, {0, 0.2}}};
  constexpr std::array<glm::dvec2, 10> kCornice{{{0, 0},
                                                 {0.05, 0.04},
                                                 {0.05, 0.1},
                                                 {0.14, 0.22},
                                                 {0.2, 0.26},
                                                 {0.3, 0.28},
                                                 {0.3, 0.38},
                                                 {0.36, 0.46},
                                                 {0.4, 0.52},
                                                 {0, 0.6}}};
  Shape shape;
  shape.append(cornice(face, kString), translation({0, kGallery - kSlab, 0}));
  shape.append(cornice(face, kCornice), translation({0, kEaves - 0.6, 0}));
  // Dentils under the upper cornice.
  const double bottom = kEaves - 0.55, top = kEaves - 0.36;
  for (double x = -face.x + 0.2; x < face.x - 0.2; x += 0.24)
    for (const double side : {-1.0, 1.0}) {
      const double z = side * face.y, inner = z - side * 0.14;
      shape.box({x, bottom, std::min(z, inner)}, {x + 0.12, top, std::max(z, inner)});
    }
  for (double z = -face.y + 0.2; z < face.y - 0.2; z += 0.24)
    for (const double side : {-1.0, 1.0}) {
      const double x = side * face.x, inner = x - side * 0.14;
      shape.box({std::min(x, inner), bottom, z}, {std::max(x, inner), top, z + 0.12});
    }
  builder.addInstance("cornices", addMesh(builder, "cornices", std::move(shape), paints.stone),
                      glm::dmat4(1));
}

// Long walls with pilasters and doors; end walls with arched windows on both storeys.
void addWalls(SceneBuilder& builder, const Paints& paints) {
  Shape wall, wood;
  for (const double side : {-1.0, 1.0}) {
    const double inner = side * kHalfZ, outer = side * (kHalfZ + kWall);
    wall.box({-kHalfX - kWall, -0.3, std::min(inner, outer)}, {kHalfX + kWall, kTop, std::max(inner, outer)});
    for (int i = 0; i <= kBaysX; ++i) {
      const double x = kBay * i - kCourtX, proud = inner - side * 0.1;
      wall.box({x - 0.2, 0, std::min(inner, proud)}, {x + 0.2, kEaves - 0.3, std::max(inner, proud)});
    }
    for (int i = 1; i < kBaysX; i += 3) {
      const double x = kBay * (i + 0.5) - kCourtX, proud = inner - side * 0.07;
      for (const double y : {0.0, kGallery}) {
        wood.box({x - 0.6, y, std::min(inner, proud)}, {x + 0.6, y + 2.5, std::max(inner, proud)});
        for (const double panel : {-0.5, 0.06})
          for (const double row : {0.2, 1.4}) {
            const double z = proud - side * 0.03;
            wood.box({x + panel, y + row, std::min(proud, z)},
                     {x + panel + 0.44, y + row + 0.9, std::max(proud, z)});
          }
      }
    }
    // End walls: sill, windows between piers, and what is above them.
    const double from = side * kHalfX, to = side * (kHalfX + kWall);
    const double lo = std::min(from, to), hi = std::max(from, to);
    const auto band = [&](double bottom, double top) { wall.box({lo, bottom, -kHalfZ}, {hi, top, kHalfZ}); };
    constexpr double kSill = 0.9, kWindowWall = 1.8;  // springing above the sill
    for (const double floor : {0.0, kGallery}) {
      band(floor == 0 ? -0.3 : kSill + kWindowWall + kWindow.height, floor + kSill);
      for (int i = 0; i <= 5; ++i) {
        const double z = kWindowBay * i - kHalfZ, half = kWindowBay / 2 - kWindow.radius;
        wall.box({lo, floor + kSill, std::max(z - half, -kHalfZ)},
                 {hi, floor + kSill + kWindowWall, std::min(z + half, kHalfZ)});
      }
    }
    band(kGallery + kSill + kWindowWall + kWindow.height, kTop);
  }
  builder.addInstance("walls",
                      addMesh(builder, "walls", std::move(wall), paints.wall, std::move(wood), paints.wood),
                      glm::dmat4(1));
  const std::uint32_t window = addMesh(builder, "window", archBay(kWindow), paints.stone);
  for (const double floor : {0.0, kGallery})
    for (int i = 0; i < 5; ++i) {
      const double z = kWindowBay * (i + 0.5) - kHalfZ, y = floor + 0.9 + 1.8, x = kHalfX + kWall / 2;
      builder.addInstance("window", window, translation({x, y, z}) * turnedY(0.75));
      builder.addInstance("window", window, translation({-x, y, z}) * turnedY(0.25));
    }
}

// Tiled slopes from the outer walls down to the eaves.
void addRoof(SceneBuilder& builder, const Paints& paints) {
  Shape shape;
  const glm::dvec2 inner(kCourtX - 0.5, kCourtZ - 0.5);
  const double high = kTop - 0.3, low = kEaves + 0.02;
  const auto slope = [&](const glm::dvec2& outerFrom, const glm::dvec2& outerTo, const glm::dvec2& innerFrom,
                         const glm::dvec2& innerTo, unsigned tiles) {
    shape.surface(tiles * 4, 4, [&](double u, double v) {
      const glm::dvec2 p = glm::mix(glm::mix(innerFrom, innerTo, u), glm::mix(outerFrom, outerTo, u), v);
      const double ripple = 0.05 * (1 - cosTurns(u * tiles));
      return glm::dvec3(p.x, low + (high - low) * v + ripple, p.y);
    });
  };
  const double x = kHalfX, z = kHalfZ;
  slope({-x, z}, {x, z}, {-inner.x, inner.y}, {inner.x, inner.y}, 90);
  slope({x, -z}, {-x, -z}, {inner.x, -inner.y}, {-inner.x, -inner.y}, 90);
  slope({x, z}, {x, -z}, {inner.x, inner.y}, {inner.x, -inner.y}, 36);
  slope({-x, -z}, {-x, z}, {-inner.x, -inner.y}, {-inner.x, inner.y}, 36);
  builder.addInstance("roof", addMesh(builder, "roof", std::move(shape), paints.roof), glm::dmat4(1));

  Shape ceiling;
  addRing(ceiling, kEaves - 0.04, kEaves, 0);
  builder.addInstance("ceiling", addMesh(builder, "ceiling", std::move(ceiling), paints.wood), glm::dmat4(1));
}

void addFurniture(SceneBuilder& builder, const Paints& paints) {
  Random random(20111);
  // Curtains in every other lower arch of the long sides, and banners over the balustrades.
  Shape rods;
  for (int i = 0; i < kBaysX; ++i) {
    const double x = kBay * (i + 0.5) - kCourtX;
    for (const double side : {-1.0, 1.0}) {
      const bool isCurtain = i % 2 == (side > 0 ? 1 : 0), isBanner = i % 4 == (side > 0 ? 2 : 1);
      if (!isCurtain && !isBanner) continue;
      const std::uint32_t cloth = paints.cloth[static_cast<std::size_t>(i + (side > 0 ? 1 : 0)) % 3];
      const double z = side * (isCurtain ? kCourtZ + 0.42 : kCourtZ - 0.48),
                   y = isCurtain ? 3.75 : kGallery + 0.55;
      Shape shape = isCurtain ? curtain(1.95, 3.1, random) : curtain(1.3, 3.6, random);
      const double half = isCurtain ? 1.1 : 0.75;
      const std::array<glm::dvec3, 2> rod{glm::dvec3{x - half, y, z}, glm::dvec3{x + half, y, z}};
      constexpr std::array<double, 2> kRadii{0.02, 0.02};
      rods.tube(rod, kRadii, 8);
      builder.addInstance("curtain", addMesh(builder, "curtain", std::move(shape), cloth),
                          translation({x, y, z}));
    }
  }
  builder.addInstance("rods", addMesh(builder, "rods", std::move(rods), paints.metal), glm::dmat4(1));

  Lamp lamp = hangingLamp(11);
  const std::uint32_t lampMesh =
      addMesh(builder, "lamp", std::move(lamp.metal), paints.metal, std::move(lamp.glass), paints.glass);
  for (const double x : {-7.5, -2.5, 2.5, 7.5})
    for (const double side : {-1.0, 1.0})
      builder.addInstance("lamp", lampMesh, translation({x, kGallery - kSlab, side * (kCourtZ + 1.6)}));

  // Potted plants along the court and in its corners.
  std::array<std::uint32_t, 3> plants;
  for (std::uint32_t& mesh : plants) {
    Plant grown = plant(34, random);
    mesh = addMesh(builder, "plant", std::move(grown.pot), paints.pot, std::move(grown.leaves), paints.leaf);
  }
  for (int i = 0; i < 12; ++i) {
    const double x = -8.75 + 3.5 * (i % 6), z = (i < 6 ? -1 : 1) * 2.75;
    builder.addInstance(
        "plant", plants[static_cast<std::size_t>(i) % 3],
        translation({x, 0, z}) * turnedY(random.unit()) * scaling(glm::dvec3(random.range(0.85, 1.25))));
  }
}

void makeAtrium(SceneBuilder& builder, const Values&) {
  const Paints paints = addPaints(builder);
  addArcades(builder, paints);
  addFloors(builder, paints);
  addCornices(builder, paints);
  addWalls(builder, paints);
  addRoof(builder, paints);
  addFurniture(builder, paints);

  builder.addView(view("main", {-10.4, 2.3, 2.2}, {2, 3.4, -1.6}, 62));
  builder.addView(view("gallery", {-10.9, 7.4, 0.5}, {0, 3.0, -1.2}, 65));
  builder.addView(view("arcade", {10.8, 1.7, -5.6}, {-2, 2.0, -4.4}, 60));
  builder.addView(view("above", {-15.5, 20, 5}, {-0.5, 3.5, -0.6}, 50));
  builder.addView(view("curtain", {1.6, 1.6, -0.4}, {-1.4, 2.0, -4.1}, 55));
  builder.addLight(sun("sun", 50, 0.07));
  builder.addLight(sun("low", 5, 0.015));
  builder.addLight(sun("noon", 80, 0.1));
  builder.addLight(spot("spot", {-6, 9.5, 2}, {2, 0, -2.5}, 70));
  builder.addLight({"lamp", {.kind = LightKind::point, .position = {0, 4.2, 0}}});
  builder.addPath(
      {"walk",
       {view("", {-10.5, 1.7, 0.5}, {0, 2.5, -1}, 60).view, view("", {-4, 1.7, 1.5}, {4, 2.2, -2}, 60).view,
        view("", {3, 1.7, -1}, {9, 2.5, 2}, 60).view, view("", {9.5, 1.7, 0}, {0, 2.5, 1.5}, 60).view},
       240});
  builder.addPath(
      {"gallery",
       {view("", {-10, 7.1, -5.2}, {0, 4, 0}, 60).view, view("", {0, 7.1, -5.2}, {4, 3, 1}, 60).view,
        view("", {10, 7.1, -5.2}, {4, 3, 1}, 60).view},
       180});
  // From a wall a few steps away along it into the court: the turn itself takes two frames.
  const View wall = view("", {2, 3, -1.2}, {2, 3, -4.1}, 60).view;
  const View court = view("", {2, 3, -1.2}, {0, 3, -4.1}, 60).view;
  builder.addPath({"turn", {wall, wall, court, court}, 7});
  builder.addPath({"pan",
                   {view("", {-10.5, 1.7, 0.5}, {2, 2.5, -2.0}, 60).view,
                    view("", {-10.5, 1.7, 0.5}, {2, 2.5, -0.5}, 60).view},
                   60});
  builder.addLightPath(
      {"day", {sun("", 15, 0.02).light, sun("", 80, 0.2).light, sun("", 15, 0.45).light}, 120});
}

}  // namespace

const Row kAtrium{
    "atrium", "a courtyard with colonnades, arches, balustrades, curtains, lamps and plants", {}, makeAtrium};

}  // namespace sundial::builtin
