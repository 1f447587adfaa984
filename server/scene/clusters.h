// Splits triangles into clusters that are compact in space, so that culling by their boxes pays.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace sundial {

struct TriangleClusters {
  std::vector<std::uint32_t> order;  // a permutation of the triangles, cluster by cluster; ascending in each
  std::vector<std::uint32_t> first;  // per cluster: where it begins in `order`; one more entry marks the end
};

// `indices`: three a triangle, each < positions.size(). Each cluster has 1 to kMaxClusterTriangles triangles.
// The result depends on nothing but the arguments.
TriangleClusters clusterTriangles(std::span<const glm::vec3> positions,
                                  std::span<const std::uint32_t> indices);

}  // namespace sundial
