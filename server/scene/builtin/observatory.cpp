// An observatory, 17 m across: a drum of twelve arched bays, a ribbed dome with a slit that sunlight falls
// through, a gallery, a telescope on its pier, and a lamp in the midst of it all. Stands in for the scene of
// that name in [NOTW], which can't be had.
#include <algorithm>
#include <array>

#include "scene/builtin/atrium_parts.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/facade.h"
#include "scene/builtin/observatory_parts.h"

namespace sundial::builtin {

namespace {

constexpr int kSides = 12;
constexpr double kRadius = 8;                        // of the drum's corners, inside
constexpr double kGallery = 3, kGalleryWidth = 1.4;  // its height, and how far it stands out
constexpr double kDrum = 5.2;                        // where the dome begins

struct Paints {
  std::uint32_t wall, stone, copper, steel, white, wood, floor, inlay, brass, glass;
  std::array<std::uint32_t, 3> book;
};

Paints addPaints(SceneBuilder& b) {
  return {.wall = addColour(b, "plaster", {0.62f, 0.58f, 0.5f}),
          .stone = addColour(b, "stone", {0.5f, 0.45f, 0.38f}),
          .copper = addColour(b, "copper", {0.2f, 0.36f, 0.31f}, true),
          .steel = addColour(b, "steel", {0.28f, 0.3f, 0.33f}),
          .white = addColour(b, "enamel", {0.75f, 0.74f, 0.7f}),
          .wood = addColour(b, "wood", {0.22f, 0.12f, 0.06f}),
          .floor = addColour(b, "floor", {0.45f, 0.42f, 0.38f}),
          .inlay = addColour(b, "inlay", {0.24f, 0.2f, 0.2f}),
          .brass = addColour(b, "brass", {0.55f, 0.38f, 0.12f}),
          .glass = addColour(b, "lamp glass", {0.8f, 0.7f, 0.45f}, true),
          .book = {addColour(b, "red books", {0.4f, 0.06f, 0.05f}),
                   addColour(b, "green books", {0.06f, 0.2f, 0.1f}),
                   addColour(b, "blue books", {0.06f, 0.1f, 0.3f})}};
}

// Calls place(transform) for each side of the drum: x along it, z outwards, at its middle.
template <class Place>
void eachSideOfDrum(double y, Place place) {
  for (int i = 0; i < kSides; ++i)
    place(turnedY((i + 0.5) / kSides) * translation({0, y, kRadius * cosTurns(0.5 / kSides)}));
}

void addDrum(SceneBuilder& builder, const Paints& paints) {
  // As long as the outer faces, so that the corners are closed.
  const double side =
      2 * (kRadius * cosTurns(0.5 / kSides) + 0.25) * sinTurns(0.5 / kSides) / cosTurns(0.5 / kSides);
  const ArchSize arch{.width = side, .height = kDrum - 3.4, .thickness = 0.5, .radius = 0.75};
  Shape wall;
  const double half = arch.width / 2, pier = half - arch.radius;
  wall.box({-half, -0.4, -0.25}, {half, 1.4, 0.25});
  wall.box({-half, 1.4, -0.25}, {-half + pier, 3.4, 0.25});
  wall.box({half - pier, 1.4, -0.25}, {half, 3.4, 0.25});
  Shape stone;
  stone.box({-arch.radius - 0.15, 1.34, -0.4}, {arch.radius + 0.15, 1.44, 0.4});
  // Bars of the window.
  for (const double x : {-0.37, 0.0, 0.37}) stone.box({x - 0.02, 1.4, -0.02}, {x + 0.02, 4.05, 0.02});
  for (const double y : {1.9, 2.4, 2.9, 3.4}) stone.box({-0.75, y - 0.02, -0.02}, {0.75, y + 0.02, 0.02});
  const std::uint32_t wallMesh = addMesh(builder, "drum wall", std::move(wall), paints.wall);
  const std::uint32_t stoneMesh = addMesh(builder, "window", std::move(stone), paints.stone);
  const std::uint32_t archMesh = addMesh(builder, "drum arch", archBay(arch), paints.wall);
  eachSideOfDrum(0, [&](const glm::dmat4& m) {
    builder.addInstance("drum wall", wallMesh, m);
    builder.addInstance("window", stoneMesh, m);
    builder.addInstance("drum arch", archMesh, m * translation({0, 3.4, 0}));
  });
  // Pillars in every other corner carry the gallery.
  const std::uint32_t pillar = addMesh(builder, "pillar", column(kGallery - 0.2, 0.16, 6), paints.stone);
  for (int i = 0; i < kSides; i += 2) {
    const double turn = static_cast<double>(i) / kSides, r = kRadius - 0.45;
    builder.addInstance("pillar", pillar, translation({r * sinTurns(turn), 0, r * cosTurns(turn)}));
  }
}

void addFloor(SceneBuilder& builder, const Paints& paints) {
  Shape floor, inlay;
  constexpr std::array<double, 8> kRings{0.9, 1.9, 2.9, 3.9, 5.0, 6.0, 7.0, 8.2};
  for (std::size_t ring = 0; ring + 1 < kRings.size(); ++ring)
    for (int i = 0; i < 36; ++i)
      (ring % 3 == 2 || (ring < 2 && i % 3 == 0) ? inlay : floor)
          .append(floorTile(kRings[ring] + 0.01, kRings[ring + 1], 36), turnedY(i / 36.0));
  const std::array<glm::dvec2, 3> below{glm::dvec2{8.6, -0.4}, {8.6, -0.014}, {0, -0.014}};
  inlay.lathe(below, 36);
  builder.addInstance("floor", addMesh(builder, "floor", std::move(floor), paints.floor), glm::dmat4(1));
  builder.addInstance("inlay", addMesh(builder, "inlay", std::move(inlay), paints.inlay), glm::dmat4(1));
}

void addGallery(SceneBuilder& builder, const Paints& paints) {
  const double inner = kRadius - 0.3 - kGalleryWidth;
  Shape slab;
  const std::array<glm::dvec2, 5> section{glm::dvec2{kRadius, kGallery - 0.18},
                                          {inner, kGallery - 0.18},
                                          {inner, kGallery},
                                          {inner + 0.01, kGallery},
                                          {kRadius, kGallery}};
  std::array<glm::dvec2, 5> outwards = section;
  std::ranges::reverse(outwards);
  slab.lathe(outwards, 48);
  builder.addInstance("gallery", addMesh(builder, "gallery", std::move(slab), paints.wood), glm::dmat4(1));
  // The stairs come up where the railing leaves a gap.
  const double width = 2 * inner * sinTurns(0.5 / 24);
  const std::uint32_t rail = addMesh(builder, "railing", railing(width, 1.0, 7), paints.steel);
  for (int i = 1; i < 24; ++i)
    builder.addInstance("railing", rail, turnedY(i / 24.0) * translation({0, kGallery, inner}));
  builder.addInstance("stairs", addMesh(builder, "stairs", windingStairs(kGallery, 18), paints.steel),
                      translation({0, 0, inner - 1.15}));
}

void addDome(SceneBuilder& builder, const Paints& paints) {
  constexpr DomeSize kDome{.radius = kRadius + 0.1, .slit = 1.3};
  const glm::dmat4 place = translation({0, kDrum, 0}) * turnedY(0.03);
  builder.addInstance("dome", addMesh(builder, "dome", domeShell(kDome), paints.copper), place);
  builder.addInstance("ribs", addMesh(builder, "ribs", domeRibs(kDome), paints.steel), place);
  Shape rail;
  const std::array<glm::dvec2, 6> kProfile{{{kRadius + 0.4, -0.25},
                                            {kRadius + 0.4, 0.1},
                                            {kRadius - 0.1, 0.1},
                                            {kRadius - 0.2, -0.05},
                                            {kRadius - 0.35, -0.15},
                                            {kRadius - 0.35, -0.25}}};
  rail.lathe(kProfile, 72);
  builder.addInstance("ring", addMesh(builder, "ring", std::move(rail), paints.stone),
                      translation({0, kDrum, 0}));
}

void addTelescope(SceneBuilder& builder, const Paints& paints) {
  Telescope telescope = makeTelescope();
  builder.addInstance("pier", addMesh(builder, "pier", std::move(telescope.pier), paints.stone),
                      glm::dmat4(1));
  builder.addInstance("mount", addMesh(builder, "mount", std::move(telescope.mount), paints.steel),
                      glm::dmat4(1));
  builder.addInstance("telescope", addMesh(builder, "telescope", std::move(telescope.tube), paints.white),
                      glm::dmat4(1));
  builder.addInstance("finder", addMesh(builder, "finder", std::move(telescope.brass), paints.brass),
                      glm::dmat4(1));
}

void addFurniture(SceneBuilder& builder, const Paints& paints) {
  Random random(1609);
  for (int i = 0; i < 4; ++i) {
    const glm::dmat4 place = turnedY((2.5 + 2 * i) / kSides) * translation({0, 0, kRadius - 0.75});
    Bookcase shelf = bookcase(1.8, 2.3, 5, random);
    builder.addInstance("bookcase", addMesh(builder, "bookcase", std::move(shelf.wood), paints.wood), place);
    for (std::size_t c = 0; c < 3; ++c)
      builder.addInstance("books", addMesh(builder, "books", std::move(shelf.books[c]), paints.book[c]),
                          place);
  }
  const std::uint32_t desk = addMesh(builder, "desk", table(1.8, 0.8, 0.76), paints.wood);
  const std::uint32_t stool = addMesh(builder, "stool", lathedStool(), paints.wood);
  for (const double turn : {0.08, 0.62, 0.8}) {
    const glm::dmat4 place = turnedY(turn) * translation({0, 0, 4.6});
    builder.addInstance("desk", desk, place);
    builder.addInstance("stool", stool, place * translation({0.3, 0, -0.7}));
  }
  Lamp lamp = hangingLamp(4);
  const std::uint32_t metal = addMesh(builder, "lamp", std::move(lamp.metal), paints.brass);
  const std::uint32_t glass = addMesh(builder, "lamp glass", std::move(lamp.glass), paints.glass);
  for (int i = 0; i < kSides; i += 3) {
    const double turn = (i + 0.5) / kSides, r = kRadius - 1.1;
    const glm::dmat4 place = translation({r * sinTurns(turn), kGallery - 0.18, r * cosTurns(turn)});
    builder.addInstance("lamp", metal, place);
    builder.addInstance("lamp glass", glass, place);
  }
}

void makeObservatory(SceneBuilder& builder, const Values&) {
  const Paints paints = addPaints(builder);
  addDrum(builder, paints);
  addFloor(builder, paints);
  addGallery(builder, paints);
  addDome(builder, paints);
  addTelescope(builder, paints);
  addFurniture(builder, paints);

  builder.addView(view("main", {-5.4, 4.7, 4.2}, {1.6, 2.0, -2.2}, 70));
  builder.addView(view("floor", {4.9, 1.7, 3.6}, {-1.5, 2.4, -2.5}, 65));
  builder.addView(view("gallery", {6.9, 4.6, -1.5}, {-3, 2.2, 1.2}, 65));
  builder.addView(view("dome", {3.2, 1.6, -4.6}, {-0.6, 8.0, 1.8}, 70));
  builder.addView(view("outside", {-19, 9, 15}, {0, 5.5, 0}, 45));
  builder.addLight(sun("sun", 50, 0.95));
  builder.addLight(sun("low", 5, 0.94));
  builder.addLight(sun("noon", 80, 0.95));
  builder.addLight(spot("spot", {-3.5, 9.6, 3.0}, {1.2, 0, -1.5}, 80));
  builder.addLight({"lamp", {.kind = LightKind::point, .position = {2.7, 4.4, 1.2}}});
  builder.addPath(
      {"walk",
       {view("", {5.5, 1.7, 3.2}, {-1, 2.2, -1}, 65).view, view("", {4.6, 1.7, -3.6}, {-2, 2, 1}, 65).view,
        view("", {-2.8, 1.7, -5.2}, {1, 2.5, 1}, 65).view},
       120});
  builder.addPath({"gallery",
                   {view("", {6.9, 4.6, -1.5}, {-3, 2.2, 1.2}, 65).view,
                    view("", {3.9, 4.6, -5.9}, {-2, 2.2, 1.5}, 65).view},
                   90});
  builder.addLightPath(
      {"day", {sun("", 20, 0.85).light, sun("", 70, 0.95).light, sun("", 20, 0.05).light}, 120});
}

}  // namespace

const Row kObservatory{"observatory",
                       "a domed hall with a slit for the sun, a telescope, and a lamp in its midst",
                       {},
                       makeObservatory};

}  // namespace sundial::builtin
