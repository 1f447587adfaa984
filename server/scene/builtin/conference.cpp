// A conference room, 18 x 10 x 3.9 m: a long table with chairs around it, two more rows along a wall, blinds
// before high windows, a coffered ceiling with lamps and roof lights, panelled walls, plants. Stands in for
// the scene of that name in [NOTW], which can't be shipped.
#include <array>

#include "scene/builtin/atrium_parts.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/conference_parts.h"
#include "scene/builtin/leaf_texture.h"

namespace sundial::builtin {

namespace {

constexpr double kHalfX = 9, kHalfZ = 5, kCeiling = 3.5, kWall = 0.3;
constexpr double kTableLength = 11, kTableWidth = 2.4, kTableHeight = 0.75;
constexpr int kWindows = 6;
constexpr double kWindowWidth = 2.0, kWindowPitch = 2.9, kSill = 0.8, kWindowHeight = 2.2;

struct Paints {
  std::uint32_t wall, panel, carpet, ceiling, table, metal, cloth, blind, lamp, screen, paper, pot, leaf,
      plastic;
};

Paints addPaints(SceneBuilder& b) {
  return {.wall = addColour(b, "wall", {0.66f, 0.63f, 0.56f}),
          .panel = addColour(b, "panels", {0.3f, 0.17f, 0.09f}),
          .carpet = addColour(b, "carpet", {0.2f, 0.22f, 0.27f}),
          .ceiling = addColour(b, "ceiling", {0.72f, 0.71f, 0.68f}),
          .table = addColour(b, "table", {0.38f, 0.2f, 0.1f}),
          .metal = addColour(b, "metal", {0.3f, 0.31f, 0.33f}),
          .cloth = addColour(b, "cloth", {0.07f, 0.09f, 0.16f}),
          .blind = addColour(b, "blinds", {0.7f, 0.68f, 0.62f}, true),
          .lamp = addColour(b, "lamps", {0.8f, 0.78f, 0.7f}),
          .screen = addColour(b, "screen", {0.8f, 0.8f, 0.8f}),
          .paper = addColour(b, "paper", {0.75f, 0.75f, 0.72f}),
          .pot = addColour(b, "pots", {0.35f, 0.33f, 0.3f}),
          .leaf = addLeafMaterial(b, "leaves", leafTexture(), {0.85f, 1.0f, 0.8f}),
          .plastic = addColour(b, "plastic", {0.05f, 0.05f, 0.06f})};
}

double windowX(int i) { return kWindowPitch * (i - 0.5 * (kWindows - 1)); }

// Of the 9 x 5 squares of the ceiling: three let the sun in, in front of the table.
bool isRoofLight(int i, int j) { return j == 1 && (i == 2 || i == 4 || i == 6); }

// The wall of windows is at z = -kHalfZ, the light comes through it.
void addRoom(SceneBuilder& builder, const Paints& paints) {
  Shape wall, panel, carpet;
  carpet.box({-kHalfX, -0.2, -kHalfZ}, {kHalfX, 0, kHalfZ});
  const double top = kCeiling + 0.4, low = -kHalfZ - kWall;
  wall.box({-kHalfX - kWall, -0.2, kHalfZ}, {kHalfX + kWall, top, kHalfZ + kWall});
  for (const double side : {-1.0, 1.0})
    wall.box({side > 0 ? kHalfX : -kHalfX - kWall, -0.2, low},
             {side > 0 ? kHalfX + kWall : -kHalfX, top, kHalfZ});
  wall.box({-kHalfX, -0.2, low}, {kHalfX, kSill, -kHalfZ});
  wall.box({-kHalfX, kSill + kWindowHeight, low}, {kHalfX, top, -kHalfZ});
  double from = -kHalfX;
  for (int i = 0; i <= kWindows; ++i) {
    const double to = i < kWindows ? windowX(i) - kWindowWidth / 2 : kHalfX;
    wall.box({from, kSill, low}, {to, kSill + kWindowHeight, -kHalfZ});
    from = to + kWindowWidth;
  }
  // The roof, with holes for its lights.
  const double roof = kCeiling + 0.31;
  wall.box({-kHalfX - kWall, roof, low}, {kHalfX + kWall, top, -3});
  wall.box({-kHalfX - kWall, roof, -1}, {kHalfX + kWall, top, kHalfZ + kWall});
  double east = -kHalfX - kWall;
  for (int i = 0; i <= 9; ++i) {
    if (i < 9 && !isRoofLight(i, 1)) continue;
    const double to = i < 9 ? -9 + 2.0 * i : kHalfX + kWall;
    wall.box({east, roof, -3}, {to, top, -1});
    east = to + 2;
  }
  builder.addInstance("walls", addMesh(builder, "walls", std::move(wall), paints.wall), glm::dmat4(1));
  builder.addInstance("carpet", addMesh(builder, "carpet", std::move(carpet), paints.carpet), glm::dmat4(1));

  // Panels on the long wall and behind the screen, with mouldings between.
  for (int i = 0; i < 18; ++i)
    for (const auto& [y, height] : {std::pair(0.12, 0.8), {1.0, 2.1}}) {
      const double x = -kHalfX + 0.08 + i;
      panel.box({x, y, kHalfZ - 0.03}, {x + 0.84, y + height, kHalfZ});
      panel.box({x + 0.08, y + 0.08, kHalfZ - 0.05}, {x + 0.76, y + height - 0.08, kHalfZ - 0.03});
    }
  for (const double y : {0.0, 0.93, 3.2}) panel.box({-kHalfX, y, kHalfZ - 0.06}, {kHalfX, y + 0.06, kHalfZ});
  for (int i = 0; i < 10; ++i) {
    const double z = -kHalfZ + 0.08 + i;
    panel.box({-kHalfX, 0.12, z}, {-kHalfX + 0.03, 3.1, z + 0.84});
  }
  // Window frames.
  for (int i = 0; i < kWindows; ++i) {
    const double x = windowX(i), half = kWindowWidth / 2, z = -kHalfZ - 0.2;
    for (const double bar : {-half, -0.02, half - 0.04})
      panel.box({x + bar, kSill, z}, {x + bar + 0.04, kSill + kWindowHeight, z + 0.06});
    for (const double bar : {0.0, 0.72, kWindowHeight - 0.05})
      panel.box({x - half, kSill + bar, z}, {x + half, kSill + bar + 0.05, z + 0.06});
    panel.box({x - half - 0.05, kSill - 0.03, -kHalfZ}, {x + half + 0.05, kSill, -kHalfZ + 0.18});
  }
  builder.addInstance("panels", addMesh(builder, "panels", std::move(panel), paints.panel), glm::dmat4(1));

  const std::uint32_t slats =
      addMesh(builder, "blind", blind(kWindowWidth - 0.06, kWindowHeight - 0.1, 44), paints.blind);
  const std::uint32_t raised =
      addMesh(builder, "raised blind", blind(kWindowWidth - 0.06, 0.9, 44), paints.blind);
  for (int i = 0; i < kWindows; ++i)
    builder.addInstance("blind", i % 3 == 1 ? raised : slats,
                        translation({windowX(i), kSill + kWindowHeight - 0.02, -kHalfZ - 0.08}));
}

void addCeiling(SceneBuilder& builder, const Paints& paints) {
  Coffer square = coffer(2);
  const std::uint32_t frame = addMesh(builder, "coffer", std::move(square.frame), paints.ceiling);
  const std::uint32_t bars = addMesh(builder, "roof light", roofLight(2), paints.ceiling);
  const std::uint32_t lamp = addMesh(builder, "ceiling lamp", std::move(square.lamp), paints.lamp);
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 9; ++i) {
      const glm::dmat4 place = translation({-8 + 2.0 * i, kCeiling, -4 + 2.0 * j});
      if (isRoofLight(i, j)) {
        builder.addInstance("roof light", bars, place);
        continue;
      }
      builder.addInstance("coffer", frame, place);
      if (i % 2 == 0 && j % 2 == 0) builder.addInstance("ceiling lamp", lamp, place);
    }
}

void addTable(SceneBuilder& builder, const Paints& paints, Random& random) {
  LongTable made = longTable(kTableLength, kTableWidth, kTableHeight);
  builder.addInstance("table", addMesh(builder, "table", std::move(made.top), paints.table), glm::dmat4(1));
  builder.addInstance("table feet", addMesh(builder, "table feet", std::move(made.feet), paints.metal),
                      glm::dmat4(1));
  const std::uint32_t pad = addMesh(builder, "notepad", notepad(), paints.paper);
  const std::uint32_t computer = addMesh(builder, "laptop", laptop(), paints.plastic);
  const std::uint32_t bottle = addMesh(builder, "carafe", carafe(), paints.metal);
  const std::uint32_t glass = addMesh(builder, "tumbler", tumbler(), paints.lamp);
  const std::uint32_t mike = addMesh(builder, "microphone", microphone(), paints.plastic);
  for (int i = 0; i < 9; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double x = -4.4 + 1.1 * i;
      const glm::dmat4 place = translation({x, kTableHeight, 0}) * turnedY(side > 0 ? 0 : 0.5);
      const double turn = random.range(-0.03, 0.03);
      builder.addInstance(i % 2 == 0 ? "laptop" : "notepad", i % 2 == 0 ? computer : pad,
                          place * translation({0, 0, 0.85}) * turnedY(turn));
      builder.addInstance("tumbler", glass, place * translation({0.3, 0, random.range(0.55, 0.75)}));
      if (i % 3 == 1) builder.addInstance("microphone", mike, place * translation({-0.3, 0, 0.45}));
      if (i % 4 == 0) builder.addInstance("carafe", bottle, place * translation({0.5, 0, 0.35}));
    }
}

void addChairs(SceneBuilder& builder, const Paints& paints, Random& random) {
  Chair chair = officeChair();
  const std::uint32_t metal = addMesh(builder, "chair", std::move(chair.metal), paints.metal);
  const std::uint32_t cloth = addMesh(builder, "chair shell", std::move(chair.cloth), paints.cloth);
  const auto seat = [&](double x, double z, double turn) {
    const glm::dmat4 place = translation({x + random.range(-0.06, 0.06), 0, z + random.range(-0.06, 0.06)}) *
                             turnedY(turn + random.range(-0.06, 0.06));
    builder.addInstance("chair", metal, place);
    builder.addInstance("chair shell", cloth, place);
  };
  for (int i = 0; i < 9; ++i)
    for (const double side : {-1.0, 1.0}) seat(-4.4 + 1.1 * i, side * 1.55, side > 0 ? 0 : 0.5);
  seat(-5.95, 0, 0.75);
  seat(5.95, 0, 0.25);
  for (int i = 0; i < 16; ++i) seat(-7.2 + 0.96 * i, 4.2, 0);
  for (int i = 0; i < 5; ++i) seat(8.1, -3.4 + 1.3 * i, 0.25);
}

void addFurniture(SceneBuilder& builder, const Paints& paints, Random& random) {
  Shape screen, stand;
  screen.box({-kHalfX + 0.1, 1.0, -1.9}, {-kHalfX + 0.13, 3.0, 1.9});
  stand.box({-kHalfX + 0.05, 2.98, -2.0}, {-kHalfX + 0.2, 3.1, 2.0});
  // A lectern, and a projector that hangs from the ceiling.
  stand.box({-7.5, 0, 2.3}, {-7.0, 1.05, 2.9});
  stand.box({-7.65, 1.05, 2.2}, {-6.85, 1.1, 3.0});
  stand.box({-3.2, 2.75, -0.2}, {-2.75, 2.92, 0.2});
  stand.box({-3.0, 2.92, -0.02}, {-2.96, 3.8, 0.02});
  builder.addInstance("screen", addMesh(builder, "screen", std::move(screen), paints.screen), glm::dmat4(1));
  builder.addInstance("stand", addMesh(builder, "stand", std::move(stand), paints.plastic), glm::dmat4(1));
  for (const glm::dvec2& at : {glm::dvec2(-8.3, -4.2), {8.3, -4.3}, {-8.3, 4.3}, {8.4, 4.3}}) {
    Plant grown = plant(60, random);
    const glm::dmat4 place = translation({at.x, 0, at.y}) * scaling(glm::dvec3(1.5));
    builder.addInstance("pot", addMesh(builder, "pot", std::move(grown.pot), paints.pot), place);
    builder.addInstance("plant", addMesh(builder, "plant", std::move(grown.leaves), paints.leaf), place);
  }
}

void makeConference(SceneBuilder& builder, const Values&) {
  const Paints paints = addPaints(builder);
  Random random(1993);
  addRoom(builder, paints);
  addCeiling(builder, paints);
  addTable(builder, paints, random);
  addChairs(builder, paints, random);
  addFurniture(builder, paints, random);

  builder.addView(view("main", {7.6, 2.5, 3.4}, {-2.2, 0.6, -1.2}, 65));
  builder.addView(view("table", {-6.6, 1.5, 1.7}, {1.5, 0.6, -0.9}, 60));
  builder.addView(view("window", {-2.5, 1.6, 2.9}, {0.6, 1.0, -4.8}, 65));
  builder.addView(view("floor", {5.2, 0.5, 3.3}, {-1.5, 0.35, 0.4}, 60));
  builder.addLight(sun("sun", 50, 0.7));
  builder.addLight(sun("low", 5, 0.73));
  builder.addLight(sun("noon", 80, 0.7));
  builder.addLight(spot("spot", {3.5, 3.4, 2.5}, {-1, 0, -0.5}, 110));
  builder.addLight({"lamp", {.kind = LightKind::point, .position = {1.2, 2.6, 0.3}}});
  builder.addPath(
      {"walk",
       {view("", {7.6, 1.7, 3.2}, {-2, 0.9, -1}, 62).view, view("", {0, 1.7, 3.1}, {-5, 1.0, -1}, 62).view,
        view("", {-7.4, 1.7, 1.5}, {2, 0.8, -0.5}, 62).view},
       120});
  builder.addPath(
      {"around",
       {view("", {7.3, 2.2, 0}, {0, 0.7, 0}, 60).view, view("", {0.5, 2.2, 3.2}, {0, 0.7, 0}, 60).view,
        view("", {-7.3, 2.2, 0}, {0, 0.7, 0}, 60).view},
       90});
  builder.addLightPath(
      {"morning", {sun("", 15, 0.66).light, sun("", 45, 0.72).light, sun("", 60, 0.78).light}, 120});
}

}  // namespace

const Row kConference{"conference",
                      "a room with a long table, chairs, blinds before its windows and a coffered ceiling",
                      {},
                      makeConference};

}  // namespace sundial::builtin
