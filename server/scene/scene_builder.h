// Turns triangle soups into a Scene: drops degenerate triangles, builds clusters (meshoptimizer), gives every
// triangle its provoking vertex, brings textures to one size, computes bounds. glTF and the built-in
// generators both end here, so that everything after them sees one kind of scene.
#pragma once

#include <optional>

#include "result.h"
#include "scene/scene.h"

namespace sundial {

// Triangles of one material. `uvs` and `colours` (RGBA8, R lowest) are empty or one a position.
struct Primitive {
  std::vector<glm::vec3> positions;  // finite
  std::vector<glm::vec2> uvs;
  std::vector<std::uint32_t> colours;
  std::vector<std::uint32_t> indices;  // three a triangle, each < positions.size()
  std::uint32_t material = 0;
};

struct Texture {
  glm::uvec2 size{0};
  std::vector<glm::u8vec4> texels;  // row 0 first
};

class SceneBuilder {
 public:
  explicit SceneBuilder(std::string name);

  std::uint32_t addTexture(Texture);
  std::uint32_t addMaterial(MaterialInfo);  // gpu.texture: an index that addTexture gave, or kNoTexture
  std::uint32_t addMesh(std::string name, std::vector<Primitive>);
  void addInstance(std::string name, std::uint32_t mesh, const glm::dmat4& worldFromMesh);
  void addView(NamedView);
  void addLight(NamedLight);
  void addPath(NamedPath);
  void addLightPath(NamedLightPath);

  // Errors: invalidArgument for a non-finite vertex, an index out of range, a singular or non-finite
  // transform; each names the mesh. Consumes the builder.
  Result<Scene> finish() &&;

 private:
  Result<void> check() const;

  Scene scene_;
  std::vector<Texture> textures_;
  struct NamedMesh {
    std::string name;
    std::vector<Primitive> primitives;
  };
  std::vector<NamedMesh> meshes_;
};

}  // namespace sundial
