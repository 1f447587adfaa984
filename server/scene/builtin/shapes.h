// A small kit to model with: boxes, lathed and swept surfaces, gathered into one primitive.
#pragma once

#include <optional>
#include <span>

#include "scene/scene_builder.h"

namespace sundial::builtin {

class Shape {
 public:
  // Counter-clockwise as seen from outside.
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);
  void box(const glm::dvec3& min, const glm::dvec3& max);

  // A grid of across x along quads through point(u, v), u and v in [0, 1]; uv is (u, v). Outside is where
  // d/du x d/dv points.
  template <class Point>
  void surface(unsigned across, unsigned along, Point point) {
    const auto first = static_cast<std::uint32_t>(primitive_.positions.size());
    for (unsigned j = 0; j <= along; ++j)
      for (unsigned i = 0; i <= across; ++i) {
        const double u = static_cast<double>(i) / across, v = static_cast<double>(j) / along;
        vertex(point(u, v), glm::dvec2(u, v));
      }
    for (unsigned j = 0; j < along; ++j)
      for (unsigned i = 0; i < across; ++i) {
        const std::uint32_t corner = first + j * (across + 1) + i;
        cell(corner, corner + 1, corner + across + 2, corner + across + 1);
      }
  }

  // Turns a profile of (radius, height) around the y axis. Outside is right of the profile's direction: away
  // from the axis where it rises. Radius 0 closes it.
  void lathe(std::span<const glm::dvec2> profile, unsigned segments);

  // A round tube through points; radii one a point. Open at its ends.
  void tube(std::span<const glm::dvec3> points, std::span<const double> radii, unsigned sides);

  // Keeps the other's colours; what has none takes this shape's.
  void append(const Shape&, const glm::dmat4& transform);

  // What comes after it has this colour, linear RGB. What came before the first is white.
  void paint(const glm::vec3& linear);

  std::size_t triangles() const { return primitive_.indices.size() / 3; }
  Primitive take(std::uint32_t material) &&;

 private:
  void vertex(const glm::dvec3& position, const glm::dvec2& uv);
  void cell(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

  Primitive primitive_;
  std::optional<std::uint32_t> colour_;  // RGBA8; without one there are no vertex colours at all
};

// A mesh of one primitive.
std::uint32_t addMesh(SceneBuilder&, std::string name, Shape, std::uint32_t material);

glm::dmat4 translation(const glm::dvec3&);
glm::dmat4 turnedY(double turns);  // counter-clockwise seen from above
glm::dmat4 turnedZ(double turns);
glm::dmat4 scaling(const glm::dvec3&);

}  // namespace sundial::builtin
