#include "scene/scene.h"

namespace sundial {

namespace {
template <class T>
std::uint64_t bytesOf(const std::vector<T>& v) {
  return v.size() * sizeof(T);
}
}  // namespace

std::uint64_t Scene::bytes() const {
  std::uint64_t sum = bytesOf(vertices) + bytesOf(attributes) + bytesOf(indices) + bytesOf(sourceTriangle) +
                      bytesOf(clusters) + bytesOf(meshes) + bytesOf(instances) + bytesOf(materials);
  for (const auto& texture : textures) sum += bytesOf(texture);
  return sum;
}

}  // namespace sundial
