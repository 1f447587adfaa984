#include "shadow/scene_buffers.h"

#include <algorithm>
#include <cstring>
#include <functional>

#include "scene/edges.h"
#include "shared/bindings.h"

namespace sundial {

namespace {

constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

template <class T>
TexelBuffer uploadedTexels(const Device& device, const std::vector<T>& data, VkFormat format,
                           std::uint32_t bytesPerTexel, VkBufferUsageFlags more = 0) {
  return {device, uploaded(device, data, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | more), format,
          bytesPerTexel};
}

std::vector<shared::Triangle> listTriangles(const Scene& scene) {
  std::vector<shared::Triangle> triangles(scene.indices.size() / 3);
  for (const shared::Cluster& cluster : scene.clusters)
    for (std::uint32_t i = cluster.firstIndex; i < cluster.firstIndex + cluster.indexCount; i += 3)
      triangles[i / 3] = {{scene.indices[i], scene.indices[i + 1], scene.indices[i + 2]}, cluster.material};
  return triangles;
}

std::uint32_t bucketOf(const MaterialInfo& material, const Instance& instance) {
  const bool mirrored = glm::determinant(glm::dmat3(instance.worldFromMesh)) < 0;
  const std::uint32_t cull = material.doubleSided ? 0 : mirrored ? 2 : 1;
  return (material.masked ? shared::kFirstMaskedBucket : 0) + cull;
}

// Every cluster of every instance, sorted by bucket, each bucket filled up to whole chunks.
std::vector<shared::Draw> listDraws(const Scene& scene, std::array<glm::uvec2, shared::kBuckets>& buckets) {
  std::array<std::vector<shared::Draw>, shared::kBuckets> sorted;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
    for (std::uint32_t c = mesh.firstCluster; c < mesh.firstCluster + mesh.clusterCount; ++c)
      sorted[bucketOf(scene.materials[scene.clusters[c].material], scene.instances[i])].push_back({i, c});
  }
  std::vector<shared::Draw> draws;
  for (std::uint32_t b = 0; b < shared::kBuckets; ++b) {
    while (sorted[b].size() % shared::kDrawsPerChunk) sorted[b].push_back({shared::kNoInstance, 0});
    buckets[b] = {draws.size() / shared::kDrawsPerChunk, sorted[b].size() / shared::kDrawsPerChunk};
    draws.insert(draws.end(), sorted[b].begin(), sorted[b].end());
  }
  return draws;
}

GpuImage uploadTextures(const Device& device, const Scene& scene) {
  const bool any = !scene.textures.empty();
  const VkExtent2D extent{any ? scene.textureSize.x : 1, any ? scene.textureSize.y : 1};
  const auto layers = any ? static_cast<std::uint32_t>(scene.textures.size()) : 1u;
  GpuImage image(device, extent, VK_FORMAT_R8G8B8A8_UNORM,
                 VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                 {.layers = layers, .array = true});
  const VkDeviceSize layerBytes = VkDeviceSize{4} * extent.width * extent.height;
  const Buffer staging(device, layerBytes * layers, 0, MemoryUse::upload);
  for (std::size_t i = 0; i < scene.textures.size(); ++i)
    std::memcpy(staging.mapped<std::byte>() + i * layerBytes, scene.textures[i].data(), layerBytes);
  device.submit([&](VkCommandBuffer command) {
    transition(command, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, layers},
                                   .imageExtent = {extent.width, extent.height, 1}};
    vkCmdCopyBufferToImage(command, staging, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    transition(command, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
  return image;
}

std::vector<shared::Material> gpuMaterials(const Scene& scene) {
  std::vector<shared::Material> out;
  for (const MaterialInfo& material : scene.materials) out.push_back(material.gpu);
  return out;
}

}  // namespace

SceneBuffers::SceneBuffers(const Device& device, std::shared_ptr<const Scene> scene)
    : scene_(std::move(scene)),
      vertices_(uploadedTexels(device, scene_->vertices, VK_FORMAT_R32G32B32A32_UINT, 16,
                               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT)),
      attributes_(uploadedTexels(device, scene_->attributes, VK_FORMAT_R32G32B32A32_UINT, 16,
                                 VK_BUFFER_USAGE_VERTEX_BUFFER_BIT)),
      triangles_(uploadedTexels(device, listTriangles(*scene_), VK_FORMAT_R32G32B32A32_UINT, 16)),
      indices_(uploaded(device, scene_->indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT)),
      clusters_(uploaded(device, scene_->clusters, kStorage)),
      materials_(uploaded(device, gpuMaterials(*scene_), kStorage)),
      textures_(uploadTextures(device, *scene_)),
      sampler_(makeSampler(device, VK_FILTER_LINEAR)),
      plainColours_(scene_->textures.empty() && std::ranges::all_of(scene_->attributes, [](const auto& a) {
                      return a.colour == 0xffffffffu;
                    })) {
  drawList_ = listDraws(*scene_, buckets_);
  draws_ = uploadedTexels(device, drawList_, VK_FORMAT_R32G32_UINT, 8);
}

bool SceneBuffers::hasHoles() const {
  const auto masked = std::span(buckets_).subspan(shared::kFirstMaskedBucket);
  return std::ranges::any_of(masked, [](const glm::uvec2& bucket) { return bucket.y > 0; });
}

VkDeviceSize SceneBuffers::bytes() const {
  VkDeviceSize sum =
      places_.size() + indices_.size() + clusters_.size() + materials_.size() + textures_.bytes();
  for (const Buffer& buffer :
       {std::cref<Buffer>(vertices_), std::cref<Buffer>(attributes_), std::cref<Buffer>(triangles_),
        std::cref<Buffer>(draws_), std::cref<Buffer>(instances_)})
    sum += buffer.size();
  if (adjacent_) sum += static_cast<const Buffer&>(*adjacent_).size();
  return sum;
}

void SceneBuffers::moveTo(const Device& device, const glm::dvec3& origin) {
  if (origin_ == origin) return;
  std::vector<shared::Instance> placed;
  placed.reserve(scene_->instances.size());
  for (const Instance& instance : scene_->instances) {
    glm::dmat4 m = instance.worldFromMesh;
    m[3] -= glm::dvec4(origin, 0);
    const glm::dmat4 rows = glm::transpose(m);
    placed.push_back({{glm::vec4(rows[0]), glm::vec4(rows[1]), glm::vec4(rows[2])}});
  }
  instances_ = uploadedTexels(device, placed, VK_FORMAT_R32G32B32A32_SFLOAT, 16);
  std::vector<shared::Instance> places(drawList_.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    if (drawList_[i].instance != shared::kNoInstance) places[i] = placed[drawList_[i].instance];
  places_ = uploaded(device, places, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  origin_ = origin;
}

void SceneBuffers::bindTo(BindingSet& set) const {
  set.set(shared::kBindVertices, vertices_);
  set.set(shared::kBindAttributes, attributes_);
  set.set(shared::kBindTriangles, triangles_);
  set.set(shared::kBindClusters, clusters_);
  set.set(shared::kBindDraws, draws_);
  set.set(shared::kBindInstances, instances_);
  set.set(shared::kBindMaterials, materials_);
  set.set(shared::kBindTextures, textures_, sampler_);
  // Unless a frame brings what belongs there.
  for (const std::uint32_t binding : {shared::kBindEdges, shared::kBindEdgeSides, shared::kBindClusterEdges,
                                      shared::kBindPlanes, shared::kBindAdjacent})
    set.set(binding, triangles_);
}

void SceneBuffers::bindAdjacent(const Device& device, BindingSet& set) const {
  if (!adjacent_) adjacent_ = uploadedTexels(device, findAdjacent(*scene_), VK_FORMAT_R32_UINT, 4);
  set.set(shared::kBindAdjacent, *adjacent_);
}

void SceneBuffers::bindVertices(VkCommandBuffer command, bool withAttributes) const {
  const VkBuffer buffers[] = {static_cast<const Buffer&>(vertices_), places_,
                              static_cast<const Buffer&>(attributes_)};
  const VkDeviceSize offsets[] = {0, 0, 0};
  vkCmdBindVertexBuffers(command, 0, withAttributes ? 3 : 2, buffers, offsets);
  vkCmdBindIndexBuffer(command, indices_, 0, VK_INDEX_TYPE_UINT32);
}

std::vector<VkVertexInputBindingDescription> SceneBuffers::vertexBindings(bool withAttributes) {
  std::vector<VkVertexInputBindingDescription> out{
      {0, sizeof(shared::Vertex), VK_VERTEX_INPUT_RATE_VERTEX},
      {1, sizeof(shared::Instance), VK_VERTEX_INPUT_RATE_INSTANCE}};
  if (withAttributes) out.push_back({2, sizeof(shared::Attributes), VK_VERTEX_INPUT_RATE_VERTEX});
  return out;
}

std::vector<VkVertexInputAttributeDescription> SceneBuffers::vertexAttributes(bool withTriangle,
                                                                              bool withAttributes) {
  std::vector<VkVertexInputAttributeDescription> out{
      {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(shared::Vertex, position)}};
  if (withTriangle) out.push_back({1, 0, VK_FORMAT_R32_UINT, offsetof(shared::Vertex, triangle)});
  if (withAttributes) {
    out.push_back({2, 2, VK_FORMAT_R32G32_SFLOAT, offsetof(shared::Attributes, uv)});
    out.push_back({3, 2, VK_FORMAT_R8G8B8A8_UNORM, offsetof(shared::Attributes, colour)});
  }
  for (std::uint32_t row = 0; row < 3; ++row)
    out.push_back({4 + row, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 16 * row});
  return out;
}

}  // namespace sundial
