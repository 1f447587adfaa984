#include "scene/builtin/grid.h"

#include <algorithm>
#include <array>
#include <limits>

#include "scene/builtin/builtin.h"
#include "scene/builtin/shapes.h"

namespace sundial::builtin {

namespace {

constexpr double kPitch = 2, kSide = 1, kLowest = 0.5, kStep = 0.25;
constexpr unsigned kHeights = 8;

constexpr std::array<Parameter, 3> kParameters{
    {{"n", 0, 64, 10, "plates along each side"},
     {"ground", 0, 1, 1, "whether there is ground: without it and plates the scene is empty"},
     {"offset_km", 0, 10'000, 0, "how far everything lies from the origin along x and along z"}}};

// Neighbours differ in height, and no two rows repeat each other.
unsigned level(unsigned i, unsigned j) { return (3 * i + 5 * j) % kHeights; }

// From the lowest sun to noon and down again on the other side.
std::vector<Light> daylight() {
  return {sun("", 10, 0.02).light, sun("", 70, 0.2).light, sun("", 10, 0.45).light};
}

void makeGrid(SceneBuilder& builder, const Values& values) {
  const auto n = static_cast<unsigned>(values[0]);
  const double half = gridGroundHalf(n), reach = n * kPitch / 2;

  const glm::dvec3 offset = glm::dvec3(1, 0, 1) * (1000.0 * static_cast<double>(values[2]));
  const glm::dmat4 place = translation(offset);

  const std::uint32_t ground = addColour(builder, "ground", {0.62f, 0.6f, 0.56f}, true);
  const std::array<std::uint32_t, 2> paint{addColour(builder, "low plates", {0.1f, 0.32f, 0.55f}, true),
                                           addColour(builder, "high plates", {0.75f, 0.36f, 0.08f}, true)};
  std::array<Shape, 2> plates;
  for (const Plate& plate : gridPlates(n)) {
    const auto& [min, max] = plate.area;
    const double y = plate.height;
    plates[y >= kLowest + kStep * kHeights / 2].quad({min.x, y, max.y}, {max.x, y, max.y}, {max.x, y, min.y},
                                                     {min.x, y, min.y});
  }
  std::vector<Primitive> primitives;
  for (std::size_t i = 0; i < paint.size(); ++i)
    if (plates[i].triangles() > 0) primitives.push_back(std::move(plates[i]).take(paint[i]));
  if (values[1] != 0) {
    Shape floor;
    floor.quad({-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half});
    std::vector<Primitive> floorPrimitives;
    floorPrimitives.push_back(std::move(floor).take(ground));
    builder.addInstance("ground", builder.addMesh("ground", std::move(floorPrimitives)), place);
  }
  if (!primitives.empty())
    builder.addInstance("plates", builder.addMesh("plates", std::move(primitives)), place);

  // Without plates they still look somewhere.
  const double far = std::max(reach, 1.0);
  const auto placed = [&](const char* name, const glm::dvec3& eye, const glm::dvec3& target, double fov) {
    return view(name, eye + offset, target + offset, fov);
  };
  builder.addView(placed("main", {far * 1.1, far * 0.9, far * 1.3}, {0, 0, 0}, 45));
  builder.addView(placed("top", {0.01, far * 2.4, 0}, {0, 0, 0}, 50));
  builder.addView(placed("low", {-far * 1.15, 1.6, -far * 0.9}, {0, 0.4, 0}, 50));
  builder.addView(placed("close", {2.6, 1.5, 3.4}, {0.5, 0, 0.5}, 50));
  builder.addView(placed("sky", {0, 4, 0}, {0.5, 9, 0.5}, 60));
  builder.addView(placed("shadows", {0, 0.45, 0}, {0.1, 0, 0.07}, 90));
  builder.addView(placed("telephoto", {11, 9, 13}, {0.3, 0, 0.3}, 5));
  builder.addLight(sun("sun", 50, 0.1));
  builder.addLight(sun("low", 5, 0.07));
  builder.addLight(sun("noon", 85, 0.3));
  builder.addLight(sun("horizon", 1, 0.07));
  builder.addLight(spot("spot", glm::dvec3(1.5, 9, 2.5) + offset, offset, 100));
  builder.addLight({"lamp", {.kind = LightKind::point, .position = glm::dvec3(1.5, 5, -0.75) + offset}});
  builder.addPath({"orbit",
                   {placed("", {far * 1.3, far * 0.7, 0}, {0, 0, 0}, 45).view,
                    placed("", {0, far * 0.7, far * 1.3}, {0, 0, 0}, 45).view,
                    placed("", {-far * 1.3, far * 0.7, 0}, {0, 0, 0}, 45).view},
                   120});
  builder.addLightPath({"day", daylight(), 120});
}

}  // namespace

const Row kGrid{"grid", "square plates over a plane, whose shadow edges are known in closed form",
                kParameters, makeGrid};

std::vector<Plate> gridPlates(unsigned n) {
  std::vector<Plate> plates;
  const double first = -kPitch * (n - 1) / 2 - kSide / 2;
  for (unsigned j = 0; j < n; ++j)
    for (unsigned i = 0; i < n; ++i) {
      const glm::dvec2 min(first + kPitch * i, first + kPitch * j);
      plates.push_back({{min, min + kSide}, kLowest + kStep * level(i, j)});
    }
  return plates;
}

double gridGroundHalf(unsigned n) { return kPitch * n / 2 + 4; }

GridShadow::GridShadow(std::span<const Plate> plates, const Light& light, double height) {
  for (const Plate& plate : plates) {
    const double above = plate.height - height;
    if (above <= 0) continue;
    const auto project = [&](const glm::dvec2& p) {
      if (light.kind == LightKind::directional)
        return p - glm::dvec2(light.direction.x, light.direction.z) * (above / light.direction.y);
      const glm::dvec2 foot(light.position.x, light.position.z);
      return foot + (p - foot) * ((light.position.y - height) / (light.position.y - plate.height));
    };
    shadows_.push_back({project(plate.area.min), project(plate.area.max)});
  }
  for (std::size_t i = 0; i < shadows_.size(); ++i) {
    const auto& [min, max] = shadows_[i];
    addEdge(min, {max.x, min.y}, i);
    addEdge({min.x, max.y}, max, i);
    addEdge(min, {min.x, max.y}, i);
    addEdge({max.x, min.y}, max, i);
  }
}

// Keeps what other shadows don't cover: there it is dark on both sides.
void GridShadow::addEdge(const glm::dvec2& a, const glm::dvec2& b, std::size_t owner) {
  const int along = a.x == b.x ? 1 : 0, across = 1 - along;
  std::vector<glm::dvec2> covered;  // intervals along the edge
  for (std::size_t i = 0; i < shadows_.size(); ++i) {
    const Rectangle& other = shadows_[i];
    if (i != owner && other.min[across] < a[across] && a[across] < other.max[across])
      covered.emplace_back(other.min[along], other.max[along]);
  }
  std::ranges::sort(covered, {}, [](const glm::dvec2& interval) { return interval.x; });
  double from = a[along];
  const auto keep = [&](double to) {
    if (to <= from) return;
    Segment segment{a, b};
    segment.a[along] = from;
    segment.b[along] = to;
    edges_.push_back(segment);
  };
  for (const glm::dvec2& interval : covered) {
    keep(std::min(interval.x, b[along]));
    from = std::max(from, interval.y);
  }
  keep(b[along]);
}

bool GridShadow::lit(const glm::dvec2& xz) const {
  return std::ranges::none_of(shadows_, [&](const Rectangle& shadow) {
    return xz.x > shadow.min.x && xz.x < shadow.max.x && xz.y > shadow.min.y && xz.y < shadow.max.y;
  });
}

double GridShadow::edgeDistance(const glm::dvec2& xz) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Segment& edge : edges_)  // along an axis, so that clamping projects
    nearest = std::min(nearest, glm::distance(xz, glm::clamp(xz, edge.a, edge.b)));
  return nearest;
}

}  // namespace sundial::builtin
