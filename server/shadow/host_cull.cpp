#include "shadow/host_cull.h"

#include <algorithm>
#include <array>

namespace sundial {

namespace {

// Left, right, top, bottom, far; casters before the near plane still cast.
std::array<glm::vec4, 5> planesOf(const glm::mat4& shadowFromWorld) {
  const glm::mat4 rows = glm::transpose(shadowFromWorld);
  return {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[2]};
}

bool reaches(const WorldBox& box, const std::array<glm::vec4, 5>& planes) {
  return std::ranges::all_of(planes, [&](const glm::vec4& plane) {
    const glm::vec3 normal(plane);
    return glm::dot(normal, box.centre) + glm::dot(glm::abs(normal), box.extent) + plane.w >= 0;
  });
}

}  // namespace

std::vector<WorldBox> worldBoxes(const SceneBuffers& buffers, const glm::dvec3& origin) {
  const Scene& scene = buffers.scene();
  std::vector<WorldBox> boxes(buffers.drawCount());
  for (std::uint32_t i = 0; i < buffers.drawCount(); ++i) {
    const shared::Draw draw = buffers.draws()[i];
    if (draw.instance == shared::kNoInstance) continue;
    const shared::Cluster& cluster = scene.clusters[draw.cluster];
    glm::dmat4 place = scene.instances[draw.instance].worldFromMesh;
    place[3] -= glm::dvec4(origin, 0);
    const glm::mat4 worldFromMesh(place);
    const glm::vec3 extent = 0.5f * (cluster.boundsMax - cluster.boundsMin);
    boxes[i].centre = glm::vec3(worldFromMesh * glm::vec4(0.5f * (cluster.boundsMin + cluster.boundsMax), 1));
    for (int column = 0; column < 3; ++column)
      boxes[i].extent += glm::abs(glm::vec3(worldFromMesh[column])) * extent[column];
  }
  return boxes;
}

void cullOnHost(const SceneBuffers& buffers, const glm::dvec3& origin, const shared::Plan& plan,
                bool drawsAll, std::span<shared::DrawCommand> commands, std::span<std::uint32_t> counts) {
  const std::vector<WorldBox> boxes = worldBoxes(buffers, origin);
  std::ranges::fill(counts, 0u);
  for (std::uint32_t view = 0; view < plan.viewCount; ++view) {
    if (plan.views[view].empty != 0) continue;
    const auto planes = planesOf(plan.views[view].shadowFromWorld);
    for (std::uint32_t bucket = 0; bucket < shared::kBuckets; ++bucket) {
      const glm::uvec2 chunks = buffers.buckets()[bucket];
      const std::uint32_t first = chunks.x * shared::kDrawsPerChunk;
      std::uint32_t& count = counts[view * shared::kBuckets + bucket];
      for (std::uint32_t i = first; i < first + chunks.y * shared::kDrawsPerChunk; ++i) {
        const shared::Draw draw = buffers.draws()[i];
        if (draw.instance == shared::kNoInstance || !(drawsAll || reaches(boxes[i], planes))) continue;
        const shared::Cluster& cluster = buffers.scene().clusters[draw.cluster];
        commands[std::size_t{view} * buffers.drawCount() + first + count++] = {cluster.indexCount, 1,
                                                                               cluster.firstIndex, 0, i};
      }
    }
  }
}

}  // namespace sundial
