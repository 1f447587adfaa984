#include "scene/builtin/shapes.h"

#include <cmath>

#include "scene/builtin/random.h"

namespace sundial::builtin {

namespace {
constexpr std::uint32_t kWhite = 0xffffffffu;
}

void Shape::vertex(const glm::dvec3& position, const glm::dvec2& uv) {
  primitive_.positions.emplace_back(position);
  primitive_.uvs.emplace_back(uv);
  if (colour_) primitive_.colours.push_back(*colour_);
}

void Shape::paint(const glm::vec3& linear) {
  colour_ = 0xffu << 24;
  for (int i = 0; i < 3; ++i) *colour_ |= static_cast<std::uint32_t>(std::lround(linear[i] * 255)) << (8 * i);
  primitive_.colours.resize(primitive_.positions.size(), kWhite);
}

void Shape::cell(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  primitive_.indices.insert(primitive_.indices.end(), {a, b, c, a, c, d});
}

void Shape::quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const auto first = static_cast<std::uint32_t>(primitive_.positions.size());
  vertex(a, {0, 0});
  vertex(b, {1, 0});
  vertex(c, {1, 1});
  vertex(d, {0, 1});
  cell(first, first + 1, first + 2, first + 3);
}

void Shape::box(const glm::dvec3& min, const glm::dvec3& max) {
  const glm::dvec3 &a = min, &b = max;
  quad({a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z});
  quad({b.x, a.y, a.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z});
  quad({b.x, a.y, b.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z});
  quad({a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z});
  quad({a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z});
  quad({a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z});
}

void Shape::lathe(std::span<const glm::dvec2> profile, unsigned segments) {
  // The last row lands on the points, whatever the rounding of v.
  const auto last = static_cast<double>(profile.size() - 1);
  surface(segments, static_cast<unsigned>(profile.size() - 1), [&](double u, double v) {
    const glm::dvec2 p = profile[static_cast<std::size_t>(std::lround(v * last))];
    // The seam's two ends must be one point.
    const double turn = u < 1 ? u : 0;
    return glm::dvec3(p.x * sinTurns(turn), p.y, p.x * cosTurns(turn));
  });
}

void Shape::tube(std::span<const glm::dvec3> points, std::span<const double> radii, unsigned sides) {
  const auto last = static_cast<double>(points.size() - 1);
  surface(sides, static_cast<unsigned>(points.size() - 1), [&](double u, double v) {
    const auto i = static_cast<std::size_t>(std::lround(v * last));
    const glm::dvec3 along =
        glm::normalize(points[std::min(i + 1, points.size() - 1)] - points[i > 0 ? i - 1 : 0]);
    // A frame that doesn't twist for tubes that mostly keep to one direction.
    const glm::dvec3 helper = std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 side = glm::normalize(glm::cross(helper, along)), up = glm::cross(along, side);
    const double turn = u < 1 ? u : 0;
    return points[i] + radii[i] * (cosTurns(turn) * side + sinTurns(turn) * up);
  });
}

void Shape::append(const Shape& other, const glm::dmat4& transform) {
  const auto first = static_cast<std::uint32_t>(primitive_.positions.size());
  if (colour_ || !other.primitive_.colours.empty()) {
    std::vector<std::uint32_t>& colours = primitive_.colours;
    colours.resize(first, kWhite);
    colours.insert(colours.end(), other.primitive_.colours.begin(), other.primitive_.colours.end());
    colours.resize(first + other.primitive_.positions.size(), colour_.value_or(kWhite));
    if (!colour_) colour_ = kWhite;
  }
  for (const glm::vec3& p : other.primitive_.positions)
    primitive_.positions.emplace_back(glm::dvec3(transform * glm::dvec4(p, 1)));
  primitive_.uvs.insert(primitive_.uvs.end(), other.primitive_.uvs.begin(), other.primitive_.uvs.end());
  for (const std::uint32_t index : other.primitive_.indices) primitive_.indices.push_back(first + index);
}

Primitive Shape::take(std::uint32_t material) && {
  primitive_.material = material;
  return std::move(primitive_);
}

std::uint32_t addMesh(SceneBuilder& builder, std::string name, Shape shape, std::uint32_t material) {
  std::vector<Primitive> primitives;
  primitives.push_back(std::move(shape).take(material));
  return builder.addMesh(std::move(name), std::move(primitives));
}

glm::dmat4 translation(const glm::dvec3& t) {
  glm::dmat4 m(1);
  m[3] = glm::dvec4(t, 1);
  return m;
}

glm::dmat4 turnedY(double turns) {
  const double c = cosTurns(turns), s = sinTurns(turns);
  glm::dmat4 m(1);
  m[0] = {c, 0, -s, 0};
  m[2] = {s, 0, c, 0};
  return m;
}

glm::dmat4 turnedZ(double turns) {
  const double c = cosTurns(turns), s = sinTurns(turns);
  glm::dmat4 m(1);
  m[0] = {c, s, 0, 0};
  m[1] = {-s, c, 0, 0};
  return m;
}

glm::dmat4 scaling(const glm::dvec3& s) {
  glm::dmat4 m(1);
  m[0].x = s.x;
  m[1].y = s.y;
  m[2].z = s.z;
  return m;
}

}  // namespace sundial::builtin
