#include "scene/primitive_build.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <array>
#include <limits>

#include "scene/clusters.h"
#include "scene/provoking.h"

namespace sundial {

namespace {

constexpr std::uint32_t kUnset = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kWhite = 0xffffffffu;

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool isFinite(const glm::vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }

Result<void> check(const Primitive& primitive) {
  const std::size_t vertexCount = primitive.positions.size();
  if (vertexCount >= kUnset || primitive.indices.size() >= kUnset)
    return fail(ErrorCode::resourceExhausted,
                fmt::format("{} vertices and {} indices are more than 32 bits can number: split the mesh",
                            vertexCount, primitive.indices.size()));
  if (primitive.indices.size() % 3 != 0)
    return invalid(
        fmt::format("{} indices are not whole triangles: give three a triangle", primitive.indices.size()));
  if (!primitive.uvs.empty() && primitive.uvs.size() != vertexCount)
    return invalid(fmt::format("{} texture coordinates for {} positions: give as many or none",
                               primitive.uvs.size(), vertexCount));
  if (!primitive.colours.empty() && primitive.colours.size() != vertexCount)
    return invalid(fmt::format("{} colours for {} positions: give as many or none", primitive.colours.size(),
                               vertexCount));
  for (std::size_t i = 0; i < primitive.indices.size(); ++i)
    if (primitive.indices[i] >= vertexCount)
      return invalid(fmt::format(
          "index {} is {}, but there are {} vertices: the mesh is damaged or was exported wrongly", i,
          primitive.indices[i], vertexCount));
  for (std::size_t i = 0; i < vertexCount; ++i)
    if (!isFinite(primitive.positions[i]))
      return invalid(
          fmt::format("vertex {} has a position that is not finite: repair the mesh and export it again", i));
  for (std::size_t i = 0; i < primitive.uvs.size(); ++i)
    if (!isFinite(primitive.uvs[i]))
      return invalid(fmt::format(
          "vertex {} has a texture coordinate that is not finite: repair the mesh and export it again", i));
  return {};
}

// Zero area, seen from any corner: rounding may make them differ, and what comes later may start at any.
bool isDegenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 zero(0);
  return glm::cross(b - a, c - a) == zero || glm::cross(c - b, a - b) == zero ||
         glm::cross(a - c, b - c) == zero;
}

// A triangle list without degenerate triangles, and where each triangle comes from.
struct Triangles {
  std::vector<std::uint32_t> indices, source;
};

Triangles withoutDegenerates(const Primitive& primitive) {
  Triangles result;
  result.indices.reserve(primitive.indices.size());
  result.source.reserve(primitive.indices.size() / 3);
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const std::array triangle{primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]};
    if (isDegenerate(glm::dvec3(primitive.positions[triangle[0]]),
                     glm::dvec3(primitive.positions[triangle[1]]),
                     glm::dvec3(primitive.positions[triangle[2]])))
      continue;
    result.indices.insert(result.indices.end(), triangle.begin(), triangle.end());
    result.source.push_back(static_cast<std::uint32_t>(i / 3));
  }
  return result;
}

// Makes vertices that agree in everything one. Returns, per remaining vertex, one of the primitive's.
std::vector<std::uint32_t> weld(const Primitive& primitive, std::vector<std::uint32_t>& indices) {
  if (indices.empty()) return {};
  std::vector<meshopt_Stream> streams{{primitive.positions.data(), sizeof(glm::vec3), sizeof(glm::vec3)}};
  if (!primitive.uvs.empty()) streams.push_back({primitive.uvs.data(), sizeof(glm::vec2), sizeof(glm::vec2)});
  if (!primitive.colours.empty())
    streams.push_back({primitive.colours.data(), sizeof(std::uint32_t), sizeof(std::uint32_t)});
  std::vector<std::uint32_t> remap(primitive.positions.size());
  const std::size_t count = meshopt_generateVertexRemapMulti(remap.data(), indices.data(), indices.size(),
                                                             remap.size(), streams.data(), streams.size());
  std::vector<std::uint32_t> representative(count);
  for (std::uint32_t i = 0; i < remap.size(); ++i)
    if (remap[i] != kUnset) representative[remap[i]] = i;
  for (std::uint32_t& index : indices) index = remap[index];
  return representative;
}

}  // namespace

Result<BuiltPrimitive> buildPrimitive(const Primitive& primitive) {
  if (auto ok = check(primitive); !ok) return std::unexpected(ok.error());

  Triangles triangles = withoutDegenerates(primitive);
  BuiltPrimitive built;
  built.degenerateTriangles = primitive.indices.size() / 3 - triangles.source.size();
  const TriangleClusters clusters = clusterTriangles(primitive.positions, triangles.indices);
  std::vector<std::uint32_t> source = weld(primitive, triangles.indices);

  // Triangles cluster by cluster.
  built.indices.reserve(triangles.indices.size());
  built.sourceTriangle.reserve(clusters.order.size());
  for (const std::uint32_t triangle : clusters.order) {
    const auto corner = triangles.indices.begin() + 3 * static_cast<std::ptrdiff_t>(triangle);
    built.indices.insert(built.indices.end(), corner, corner + 3);
    built.sourceTriangle.push_back(triangles.source[triangle]);
  }

  // A vertex of its own for each triangle.
  for (const std::uint32_t original :
       assignProvokingVertices(built.indices, static_cast<std::uint32_t>(source.size())))
    source.push_back(source[original]);

  // Vertices in the order in which triangles use them, for the caches.
  std::vector<std::uint32_t> position(source.size(), kUnset);
  built.vertices.reserve(source.size());
  built.attributes.reserve(source.size());
  for (std::size_t i = 0; i < built.indices.size(); ++i) {
    std::uint32_t& vertex = built.indices[i];
    if (position[vertex] == kUnset) {
      position[vertex] = static_cast<std::uint32_t>(built.vertices.size());
      const std::uint32_t from = source[vertex];
      built.vertices.push_back({primitive.positions[from], kNoTriangle});
      built.attributes.push_back({primitive.uvs.empty() ? glm::vec2(0) : primitive.uvs[from],
                                  primitive.colours.empty() ? kWhite : primitive.colours[from]});
    }
    vertex = position[vertex];
    if (i % 3 == 0) built.vertices[vertex].triangle = static_cast<std::uint32_t>(i / 3);
  }

  for (std::size_t i = 0; i + 1 < clusters.first.size(); ++i) {
    shared::Cluster cluster{};
    cluster.firstIndex = 3 * clusters.first[i];
    cluster.indexCount = 3 * (clusters.first[i + 1] - clusters.first[i]);
    cluster.material = primitive.material;
    cluster.boundsMin = cluster.boundsMax = built.vertices[built.indices[cluster.firstIndex]].position;
    for (std::uint32_t k = 0; k < cluster.indexCount; ++k) {
      const glm::vec3& p = built.vertices[built.indices[cluster.firstIndex + k]].position;
      cluster.boundsMin = glm::min(cluster.boundsMin, p);
      cluster.boundsMax = glm::max(cluster.boundsMax, p);
    }
    built.clusters.push_back(cluster);
  }
  return built;
}

}  // namespace sundial
