// The compute rasteriser alone: triangles in clip space, straight into maps of any sizes.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

#include "shadow/rasteriser.h"
#include "shadow/scene_buffers.h"
#include "shadow/store.h"
#include "shadow/view_target.h"
#include "shared/bindings.h"
#include "support/exact_raster.h"
#include "support/tiny_scene.h"

namespace sundial::test {

// How clip space is made of a vertex's position, so that no arithmetic rounds.
enum class Projection {
  parallel,     // (x, y, z, 1)
  perspective,  // (x, y, 1, z)
};

inline glm::mat4 clipFrom(Projection projection) {
  glm::mat4 m(1);
  if (projection == Projection::perspective) {
    m[2] = {0, 0, 0, 1};
    m[3] = {0, 0, 1, 0};
  }
  return m;
}

inline std::array<glm::vec4, 3> clipOf(const Soup& soup, std::size_t triangle, Projection projection) {
  std::array<glm::vec4, 3> out;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec3& p = soup.positions[3 * triangle + i];
    out[i] = projection == Projection::parallel ? glm::vec4(p, 1) : glm::vec4(p.x, p.y, 1, p.z);
  }
  return out;
}

class RasterStage {
 public:
  explicit RasterStage(const Device& device) : device_(device), pipelines_(device) {}

  // The words that the maps hold, one map behind the other, after all triangles were drawn into each.
  std::vector<std::uint32_t> draw(const Soup& soup, Projection projection, const std::vector<MapRect>& maps,
                                  const RasterChoice& choice) {
    TinyScene tiny;
    tiny.addInstance(tiny.addMesh(soup));
    SceneBuffers scene(device_, tiny.finish());
    scene.moveTo(device_, glm::dvec3(0));

    constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    constexpr VkBufferUsageFlags kTexels =
        VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
    shared::FrameConstants constants{};
    constants.drawCount = scene.drawCount();
    for (std::uint32_t b = 0; b < shared::kBuckets; ++b) constants.drawBuckets[b] = scene.buckets()[b];
    shared::Plan plan{};
    plan.viewCount = static_cast<std::uint32_t>(maps.size());
    std::uint32_t texels = 0;
    for (std::size_t view = 0; view < maps.size(); ++view) {
      plan.views[view] = {.shadowFromWorld = clipFrom(projection),
                          .rectOffset = maps[view].offset,
                          .rectSize = maps[view].size,
                          .linearOffset = texels};
      texels += maps[view].size.x * maps[view].size.y;
    }
    // Every draw reaches every view.
    std::vector<shared::DrawCommand> commands((1 + maps.size()) * scene.drawCount());
    std::vector<std::uint32_t> counts((1 + maps.size()) * shared::kBuckets);
    for (std::size_t slot = 1; slot <= maps.size(); ++slot)
      for (std::uint32_t bucket = 0; bucket < shared::kBuckets; ++bucket) {
        const std::uint32_t first = scene.buckets()[bucket].x * shared::kDrawsPerChunk;
        for (std::uint32_t d = first; d < first + scene.buckets()[bucket].y * shared::kDrawsPerChunk; ++d) {
          const shared::Draw draw = scene.draws()[d];
          if (draw.instance == shared::kNoInstance) continue;
          const shared::Cluster& cluster = scene.scene().clusters[draw.cluster];
          commands[slot * scene.drawCount() + first + counts[slot * shared::kBuckets + bucket]++] = {
              cluster.indexCount, 1, cluster.firstIndex, 0, d};
        }
      }

    const std::uint32_t bytes = choice.ids ? 8 : 4;
    const TexelBuffer linear(device_, Buffer(device_, VkDeviceSize{texels} * bytes, kStorage | kTexels),
                             bytes == 4 ? VK_FORMAT_R32_UINT : VK_FORMAT_R32G32_UINT, bytes);
    const Buffer frameBuffer =
        uploaded(device_, &constants, sizeof constants, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    const Buffer planBuffer = uploaded(device_, &plan, sizeof plan, kStorage);
    const Buffer commandBuffer = uploaded(device_, commands, kStorage);
    const Buffer countBuffer = uploaded(device_, counts, kStorage);
    const ViewTarget target(device_, {1, 1});
    const Sampler nearest = makeSampler(device_, VK_FILTER_NEAREST);

    Rasteriser rasteriser(device_, pipelines_, choice, plan.viewCount, constants);
    BindingSet bindings(device_, pipelines_.layout);
    // Something for all that no round reads.
    for (std::uint32_t b = 1; b < shared::kBindCount; ++b) {
      if (b < shared::kStorageBindings)
        bindings.set(b, planBuffer);
      else if (b < shared::kStorageTexelBindings)
        bindings.set(b, linear);
      else
        bindings.set(b, target.visibility, nearest);
    }
    scene.bindTo(bindings);
    target.bindTo(bindings);
    bindNoStore(bindings, target.visibility, nearest, linear);
    bindings.set(shared::kBindFrame, frameBuffer);
    bindings.set(shared::kBindPlan, planBuffer);
    bindings.set(shared::kBindCommands, commandBuffer);
    bindings.set(shared::kBindCounts, countBuffer);
    rounds_ = 0;
    do {
      if (rounds_ > 0) rasteriser.makeRoom();
      rasteriser.bindTo(bindings);
      device_.submit([&](VkCommandBuffer command) {
        vkCmdFillBuffer(command, static_cast<const Buffer&>(linear), 0, VK_WHOLE_SIZE, 0);
        bindings.bind(command);
        rasteriser.record(command);
      });
      ++rounds_;
    } while (rasteriser.overflowed());
    triangles_ = rasteriser.triangles();
    return valuesOf<std::uint32_t>(downloaded(device_, linear));
  }

  // Of the last draw(): how often it had to be done, and the triangles that were looked at.
  unsigned rounds() const { return rounds_; }
  std::uint64_t triangles() const { return triangles_; }

 private:
  const Device& device_;
  FramePipelines pipelines_;
  unsigned rounds_ = 0;
  std::uint64_t triangles_ = 0;
};

}  // namespace sundial::test
