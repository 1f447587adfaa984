#include "shadow/rasteriser.h"

#include <algorithm>
#include <cstddef>

#include "shared/bindings.h"

namespace sundial {

namespace {

constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

std::uint32_t kindOf(std::uint32_t bucket) { return bucket >= shared::kFirstMaskedBucket ? 1 : 0; }

}  // namespace

Rasteriser::Rasteriser(const Device& device, FramePipelines& pipelines, const RasterChoice& choice,
                       std::uint32_t views, const shared::FrameConstants& constants)
    : device_(device),
      layout_(pipelines.layout.pipeline()),
      views_(views),
      state_(device, sizeof(shared::RasterState),
             kStorage | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT),
      host_(device, sizeof(shared::RasterState), VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback) {
  for (std::uint32_t bucket = 0; bucket < shared::kBuckets; ++bucket)
    filled_[bucket] = constants.drawBuckets[bucket].y > 0;
  const auto any = [&](std::uint32_t kind) {
    const auto* first = filled_.begin() + kind * shared::kFirstMaskedBucket;
    return std::any_of(first, first + shared::kFirstMaskedBucket, std::identity());
  };
  pipelines_ = pipelines.raster(choice, any(0), any(1));
  *host_.mapped<shared::RasterState>() = {};
  allocate({1u << 16, 1u << 14, 1u << 16});
}

void Rasteriser::allocate(const Room& room) {
  const VkDeviceSize most = device_.limits().maxStorageBufferRange;
  const auto make = [&](std::uint32_t entries, VkDeviceSize bytes) {
    const VkDeviceSize size = VkDeviceSize{shared::kRasterKinds} * entries * bytes;
    if (size > most) throw GpuError(VK_ERROR_OUT_OF_DEVICE_MEMORY, "listing a map's large triangles");
    return Buffer(device_, size, kStorage);
  };
  listed_ = make(room.listed, sizeof(shared::ListedTriangle));
  parts_ = make(room.parts, sizeof(shared::RasterPart));
  bands_ = make(room.bands, sizeof(shared::RasterBand));
  room_ = room;
}

void Rasteriser::bindTo(BindingSet& bindings) const {
  bindings.set(shared::kBindRaster, state_);
  bindings.set(shared::kBindListed, listed_);
  bindings.set(shared::kBindParts, parts_);
  bindings.set(shared::kBindBands, bands_);
}

void Rasteriser::record(VkCommandBuffer command) const {
  const auto bind = [&](VkPipeline pipeline) {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  };
  const auto push = [&](std::uint32_t view, std::uint32_t bucket) {
    const shared::RasterPush values{view, bucket, room_.listed, room_.parts, room_.bands};
    vkCmdPushConstants(command, layout_, VK_SHADER_STAGE_ALL, 0, sizeof values, &values);
  };
  bind(pipelines_.begin);
  vkCmdDispatch(command, 1, 1, 1);
  barrier(command);

  // Small triangles.
  for (std::uint32_t bucket = 0; bucket < shared::kBuckets; ++bucket) {
    if (!filled_[bucket]) continue;
    bind(pipelines_.kinds[kindOf(bucket)].clusters);
    for (std::uint32_t view = 0; view < views_; ++view) {
      push(view, bucket);
      vkCmdDispatchIndirect(command, state_,
                            offsetof(shared::RasterState, clusters) +
                                (view * shared::kBuckets + bucket) * sizeof(shared::DispatchCommand));
    }
  }
  barrier(command);

  // What they left: triangles that are clipped or large, and the bands of the large ones.
  for (const auto& [round, arguments] :
       {std::pair(&RasterPipelines::Kind::listed, offsetof(shared::RasterState, listed)),
        {&RasterPipelines::Kind::bands, offsetof(shared::RasterState, bands)}}) {
    push(0, 0);
    for (std::uint32_t kind = 0; kind < shared::kRasterKinds; ++kind) {
      if (!(pipelines_.kinds[kind].*round)) continue;
      bind(pipelines_.kinds[kind].*round);
      vkCmdDispatchIndirect(command, state_, arguments + kind * sizeof(shared::DispatchCommand));
    }
    barrier(command);
  }
  const VkBufferCopy all{0, 0, sizeof(shared::RasterState)};
  vkCmdCopyBuffer(command, state_, host_, 1, &all);
  barrier(command);
}

bool Rasteriser::overflowed() const {
  for (std::uint32_t kind = 0; kind < shared::kRasterKinds; ++kind)
    if (found().listedCount[kind] > room_.listed || found().partCount[kind] > room_.parts ||
        found().bandCount[kind] > room_.bands)
      return true;
  return false;
}

void Rasteriser::makeRoom() {
  const auto enough = [](std::uint32_t room, const shared::uint(&asked)[shared::kRasterKinds]) {
    const std::uint32_t most = *std::max_element(std::begin(asked), std::end(asked));
    return most > room ? most + most / 4 : room;
  };
  allocate({enough(room_.listed, found().listedCount), enough(room_.parts, found().partCount),
            enough(room_.bands, found().bandCount)});
}

std::uint64_t Rasteriser::bytes() const {
  return state_.size() + listed_.size() + parts_.size() + bands_.size();
}

}  // namespace sundial
