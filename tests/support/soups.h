// Scenes of loose triangles, through the builder.
#pragma once

#include "support/rendering.h"
#include "support/tiny_scene.h"

namespace sundial::test {

// Grey, two-sided meshes of loose triangles.
class Soups {
 public:
  std::uint32_t addMesh(const Soup& soup) {
    Primitive primitive{
        .positions = soup.positions, .uvs = {}, .colours = {}, .indices = {}, .material = grey_};
    for (std::uint32_t i = 0; i < soup.positions.size(); ++i) primitive.indices.push_back(i);
    return builder_.addMesh("soup", {primitive});
  }
  void addInstance(std::uint32_t mesh, const glm::dmat4& place = glm::dmat4(1)) {
    builder_.addInstance("soup", mesh, place);
  }
  std::shared_ptr<const Scene> finish() { return sharedScene(std::move(builder_).finish()); }

 private:
  SceneBuilder builder_{"soups"};
  std::uint32_t grey_ = builder_.addMaterial(
      {.name = "grey", .gpu = {glm::vec4(1), 0, shared::kNoTexture, 0, 0}, .doubleSided = true});
};

// The six walls of a cube about the origin.
inline Soup room(float half) {
  Soup soup;
  const float side = 2 * half;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      glm::vec3 corner(-half), a(0), b(0);
      corner[axis] = sign * half;
      a[(axis + 1) % 3] = side;
      b[(axis + 2) % 3] = side;
      for (const glm::vec3 p : quad(corner, a, b).positions) soup.positions.push_back(p);
    }
  return soup;
}

}  // namespace sundial::test
