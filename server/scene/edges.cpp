#include "scene/edges.h"

#include <algorithm>
#include <array>
#include <bit>
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

// The vertices of a mesh: of those in one place the first stands for all.
struct MergedVertices {
  std::uint32_t first;                // vertex
  std::vector<std::uint32_t> stands;  // of each vertex from it on: which one stands for it
};

std::size_t hashOf(const glm::vec3& place) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // The two zeros are one place.
    hash ^= std::bit_cast<std::uint32_t>(place[axis] + 0.0f);
    hash *= 0x9e3779b97f4a7c15;
    hash ^= hash >> 32;
  }
  return hash;
}

// By a table of places, open and at most half full.
MergedVertices mergedVertices(std::span<const shared::Vertex> all, std::span<const std::uint32_t> indices) {
  constexpr std::uint32_t kNone = ~0u;
  const auto [low, high] = std::ranges::minmax(indices);
  const auto vertices = all.subspan(low, high - low + 1);
  MergedVertices merged{low, std::vector<std::uint32_t>(vertices.size())};
  std::vector<std::uint32_t> table(std::bit_ceil(2 * vertices.size()), kNone);
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    std::size_t slot = hashOf(vertices[v].position) % table.size();
    while (table[slot] != kNone && vertices[table[slot]].position != vertices[v].position)
      slot = (slot + 1) % table.size();
    if (table[slot] == kNone) table[slot] = v;
    merged.stands[v] = low + table[slot];
  }
  return merged;
}

// Sorted by their vertices and triangles: counted out by the first vertex, of which each has few.
std::vector<Side> sidesOf(const Scene& scene, const Mesh& mesh) {
  if (mesh.triangleCount == 0) return {};
  const auto indices = std::span(scene.indices)
                           .subspan(std::size_t{3} * mesh.firstTriangle, std::size_t{3} * mesh.triangleCount);
  const auto [first, stands] = mergedVertices(scene.vertices, indices);
  const auto sideOf = [&](std::uint32_t i) {
    const std::uint32_t triangle = i / 3, edge = i % 3;
    const std::uint32_t a = stands[indices[i] - first],
                        b = stands[indices[3 * triangle + (edge + 1) % 3] - first];
    return Side{std::min(a, b), std::max(a, b), mesh.firstTriangle + triangle, a > b, edge};
  };
  std::vector<std::uint32_t> end(stands.size());  // of the sides whose first vertex this is
  for (std::uint32_t i = 0; i < indices.size(); ++i) ++end[sideOf(i).low - first];
  std::exclusive_scan(end.begin(), end.end(), end.begin(), 0u);
  std::vector<Side> sides(indices.size());
  for (std::uint32_t i = 0; i < indices.size(); ++i) {
    const Side side = sideOf(i);
    sides[end[side.low - first]++] = side;
  }
  std::uint32_t begin = 0;
  for (const std::uint32_t last : end) {
    std::sort(sides.begin() + begin, sides.begin() + last, [](const Side& a, const Side& b) {
      return std::tie(a.high, a.triangle, a.edge) < std::tie(b.high, b.triangle, b.edge);
    });
    begin = last;
  }
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
