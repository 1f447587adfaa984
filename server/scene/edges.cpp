#include "scene/edges.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace sundial {

namespace {

// One way along an edge, as a triangle takes it.
struct Side {
  std::uint32_t low, high;  // vertices
  std::uint32_t triangle;
  bool reversed;       // from high to low
  std::uint32_t edge;  // of the triangle's three
};

// Per index of the mesh's triangles, from its first: the one vertex that stands for all in its place.
std::vector<std::uint32_t> mergedVertices(const Scene& scene, const Mesh& mesh) {
  const auto indices = std::span(scene.indices)
                           .subspan(std::size_t{3} * mesh.firstTriangle, std::size_t{3} * mesh.triangleCount);
  std::vector<std::uint32_t> order(indices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t i) {
    const glm::vec3& p = scene.vertices[indices[i]].position;
    return std::tuple(p.x, p.y, p.z);
  };
  std::ranges::sort(order, [&](auto a, auto b) {
    return std::tuple(place(a), indices[a]) < std::tuple(place(b), indices[b]);
  });
  std::vector<std::uint32_t> merged(indices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && place(order[i]) == place(order[i - 1]);
    merged[order[i]] = same ? merged[order[i - 1]] : indices[order[i]];
  }
  return merged;
}

std::vector<Side> sidesOf(const Scene& scene, const Mesh& mesh) {
  const std::vector<std::uint32_t> vertices = mergedVertices(scene, mesh);
  std::vector<Side> sides;
  sides.reserve(vertices.size());
  for (std::uint32_t t = 0; t < mesh.triangleCount; ++t)
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t a = vertices[3 * t + c], b = vertices[3 * t + (c + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), mesh.firstTriangle + t, a > b, c});
    }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.triangle); });
  return sides;
}

glm::vec4 planeOf(const Scene& scene, std::size_t triangle) {
  std::array<glm::dvec3, 3> p;
  for (std::size_t c = 0; c < 3; ++c) p[c] = scene.vertices[scene.indices[3 * triangle + c]].position;
  const glm::dvec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
  return glm::vec4(normal, -glm::dot(normal, p[0]));
}

}  // namespace

SceneEdges findEdges(const Scene& scene) {
  SceneEdges found;
  std::vector<std::uint32_t> clusterOf(scene.indices.size() / 3);
  for (std::uint32_t c = 0; c < scene.clusters.size(); ++c)
    std::ranges::fill(
        std::span(clusterOf).subspan(scene.clusters[c].firstIndex / 3, scene.clusters[c].indexCount / 3), c);

  std::vector<std::uint32_t> cluster;  // of each edge
  for (const Mesh& mesh : scene.meshes) {
    const std::vector<Side> sides = sidesOf(scene, mesh);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const bool first =
          i == 0 || std::tie(sides[i].low, sides[i].high) != std::tie(sides[i - 1].low, sides[i - 1].high);
      if (first) {
        cluster.push_back(clusterOf[sides[i].triangle]);
        found.edges.push_back(
            {sides[i].low, sides[i].high, static_cast<std::uint32_t>(found.sides.size()), 0});
      }
      ++found.edges.back().sideCount;
      found.sides.push_back(2 * sides[i].triangle + (sides[i].reversed ? 1 : 0));
    }
  }

  found.ofCluster.resize(scene.clusters.size());
  for (const std::uint32_t c : cluster) ++found.ofCluster[c].y;
  std::uint32_t next = 0;
  for (glm::uvec2& range : found.ofCluster) range.x = std::exchange(next, next + range.y);
  std::vector<shared::Edge> sorted(found.edges.size());
  std::vector<std::uint32_t> place;
  for (const glm::uvec2& range : found.ofCluster) place.push_back(range.x);
  for (std::size_t i = 0; i < cluster.size(); ++i) sorted[place[cluster[i]]++] = found.edges[i];
  found.edges = std::move(sorted);

  for (std::size_t t = 0; t < clusterOf.size(); ++t) found.planes.push_back(planeOf(scene, t));
  return found;
}

std::vector<std::uint32_t> findAdjacent(const Scene& scene) {
  std::vector<std::uint32_t> adjacent(scene.indices.size());
  for (const Mesh& mesh : scene.meshes) {
    const std::vector<Side> sides = sidesOf(scene, mesh);
    for (auto first = sides.begin(); first != sides.end();) {
      const auto last = std::find_if(
          first, sides.end(), [&](const Side& s) { return s.low != first->low || s.high != first->high; });
      for (auto side = first; side != last; ++side) {
        const Side& next = side + 1 == last ? *first : *(side + 1);
        adjacent[3 * side->triangle + side->edge] =
            shared::adjacentSide(next.triangle, next.edge, next.reversed == side->reversed);
      }
      first = last;
    }
  }
  return adjacent;
}

}  // namespace sundial
