#include "shadow/shadow_volumes.h"

#include <fmt/format.h>

#include <algorithm>

#include "gpu/rendering.h"
#include "scene/edges.h"
#include "shadow/frame_pipelines.h"
#include "shadow/scene_buffers.h"
#include "shadow/store.h"
#include "shared/bindings.h"

namespace sundial {

namespace {

constexpr VkBufferUsageFlags kTexels = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
constexpr std::uint64_t kEdgesPerBatch = 1u << 20;

}  // namespace

std::optional<std::string> whyNoVolumes(const Scene& scene) {
  const auto masked = std::ranges::find_if(scene.materials, &MaterialInfo::masked);
  if (masked == scene.materials.end()) return std::nullopt;
  return fmt::format(
      "the volumes of whole triangles know nothing of the holes that alpha cuts into them, and material {} "
      "is "
      "alpha-tested: use ray-traced or a map",
      masked->name.empty() ? std::to_string(masked - scene.materials.begin()) : masked->name);
}

EdgeBuffers::EdgeBuffers(const Device& device, const SceneBuffers& scene) {
  const SceneEdges found = findEdges(scene.scene());
  edges_ = {device, uploaded(device, found.edges, kTexels), VK_FORMAT_R32G32B32A32_UINT, 16};
  sides_ = {device, uploaded(device, found.sides, kTexels), VK_FORMAT_R32_UINT, 4};
  ofCluster_ = {device, uploaded(device, found.ofCluster, kTexels), VK_FORMAT_R32G32_UINT, 8};
  planes_ = {device, uploaded(device, found.planes, kTexels), VK_FORMAT_R32G32B32A32_SFLOAT, 16};

  std::uint64_t edges = 0;
  for (std::uint32_t d = 0; d < scene.drawCount(); ++d) {
    const shared::Draw& draw = scene.draws()[d];
    const std::uint64_t more = draw.instance == shared::kNoInstance ? 0 : found.ofCluster[draw.cluster].y;
    if (batches_.empty() || edges + more > kEdgesPerBatch) {
      batches_.push_back({d, 0});
      edges = 0;
    }
    ++batches_.back().draws;
    edges += more;
    mostEdges_ = std::max(mostEdges_, edges);
  }
}

void EdgeBuffers::bindTo(BindingSet& bindings) const {
  bindings.set(shared::kBindEdges, edges_);
  bindings.set(shared::kBindEdgeSides, sides_);
  bindings.set(shared::kBindClusterEdges, ofCluster_);
  bindings.set(shared::kBindPlanes, planes_);
}

std::uint64_t EdgeBuffers::bytes() const {
  std::uint64_t sum = 0;
  for (const TexelBuffer* buffer : {&edges_, &sides_, &ofCluster_, &planes_})
    sum += static_cast<const Buffer&>(*buffer).size();
  return sum;
}

ShadowVolumes::ShadowVolumes(const Device& device, FramePipelines& pipelines, const EdgeBuffers& edges,
                             glm::uvec2 size)
    : edges_(edges),
      findSilhouette_(pipelines.compute("volume_edges.comp", {})),
      sides_(pipelines.volume("volume_side.vert")),
      caps_(pipelines.volume("volume_cap.vert")),
      ends_(pipelines.volume("volume_end.vert")),
      silhouette_(device, sizeof(shared::SilhouetteDraw) + edges.mostEdges() * sizeof(shared::SilhouetteEdge),
                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT),
      counts_(device, {size.x, size.y}, VK_FORMAT_R32_SFLOAT,
              VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)),
      unread_(unreadBuffer(device)) {
  device.submit([&](VkCommandBuffer command) {
    transition(command, counts_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

void ShadowVolumes::bindTo(BindingSet& bindings) const {
  bindNoStore(bindings, counts_, nearest_, unread_);
  edges_.bindTo(bindings);
  bindings.set(shared::kBindSilhouette, silhouette_);
}

void ShadowVolumes::count(VkCommandBuffer command, VkPipelineLayout layout, const DrawScene& drawCaps,
                          const DrawScene& drawEnds) const {
  renderInto(command, {&counts_}, nullptr, [&] {
    drawCaps(caps_);
    if (drawEnds) drawEnds(ends_);
  });
  for (const EdgeBuffers::Batch& batch : edges_.batches()) {
    const shared::SilhouetteDraw none{.instanceCount = 1};
    vkCmdUpdateBuffer(command, silhouette_, 0, sizeof none, &none);
    barrier(command);
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, findSilhouette_);
    vkCmdPushConstants(command, layout, VK_SHADER_STAGE_ALL, 0, sizeof batch, &batch);
    vkCmdDispatch(command, (batch.draws + 63) / 64, 1, 1);
    barrier(command);
    renderOnto(command, {&counts_}, nullptr, [&] {
      vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS, sides_);
      vkCmdDrawIndirect(command, silhouette_, 0, 1, 0);
    });
  }
}

}  // namespace sundial
