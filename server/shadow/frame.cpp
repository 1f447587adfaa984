#include "shadow/frame.h"

#include <cstring>

#include "gpu/rendering.h"
#include "shared/bindings.h"

namespace sundial {

namespace {

constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
constexpr VkBufferUsageFlags kIndirect = kStorage | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;

// As near as the reference looks.
constexpr double kBiasOfDiagonal = 2e-5;

std::uint32_t groups(std::uint32_t items, std::uint32_t perGroup) {
  return (items + perGroup - 1) / perGroup;
}

shared::FrameConstants constantsOf(const FrameView& view, const Method& method) {
  shared::FrameConstants c = view.constants;
  const auto& settings = method.settings;
  c.drawCount = view.scene.drawCount();
  for (std::uint32_t b = 0; b < shared::kBuckets; ++b) c.drawBuckets[b] = view.scene.buckets()[b];
  c.storeSize = {settings.width, settings.height};
  c.biasTexels = static_cast<float>(settings.biasTexels);
  c.biasWorld =
      static_cast<float>(settings.biasWorld.value_or(kBiasOfDiagonal * view.scene.scene().bounds.diagonal()));
  c.pcfKernel = settings.kernel;
  return c;
}

VkDeviceSize pixels(const FrameView& view) {
  return VkDeviceSize{view.constants.imageSize.x} * view.constants.imageSize.y;
}

}  // namespace

Frame::Frame(const FrameView& view, const Method& method)
    : view_(view),
      method_(method),
      shadowViews_(method.stages ? 1 : 0),
      constants_(view.device, sizeof(shared::FrameConstants), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                 MemoryUse::upload),
      analysis_(view.device, sizeof(shared::Analysis), kStorage),
      plan_(view.device, sizeof(shared::Plan), kStorage),
      commands_(view.device,
                VkDeviceSize{view.scene.drawCount()} * (1 + shadowViews_) * sizeof(shared::DrawCommand),
                kIndirect),
      visible_(view.device,
               VkDeviceSize{view.scene.drawCount()} / shared::kDrawsPerChunk * (1 + shadowViews_) *
                   sizeof(glm::uvec2),
               kStorage),
      counts_(view.device, (1 + shadowViews_) * shared::kBuckets * sizeof(std::uint32_t), kIndirect),
      nearest_(makeSampler(view.device, VK_FILTER_NEAREST)),
      bindings_(view.device, view.pipelines.layout) {
  *constants_.mapped<shared::FrameConstants>() = constantsOf(view, method);
  if (method.stages) {
    const VkExtent2D extent{method.settings.width, method.settings.height};
    map_.emplace(view.device, extent, VK_FORMAT_D32_SFLOAT,
                 VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    view.device.submit([&](VkCommandBuffer command) {
      transition(command, *map_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
  } else {
    hostPositions_.emplace(view.device, pixels(view) * sizeof(glm::uvec4), 0, MemoryUse::readback);
    hostNormals_.emplace(view.device, pixels(view) * sizeof(glm::uvec4), 0, MemoryUse::readback);
    hostVisibility_.emplace(view.device, pixels(view) * sizeof(float), 0, MemoryUse::upload);
  }
  bindTo(bindings_, view.target);
}

void Frame::bindTo(BindingSet& bindings, const ViewTarget& samples) const {
  view_.scene.bindTo(bindings);
  samples.bindTo(bindings);
  bindings.set(shared::kBindFrame, constants_);
  bindings.set(shared::kBindAnalysis, analysis_);
  bindings.set(shared::kBindPlan, plan_);
  bindings.set(shared::kBindCommands, commands_);
  bindings.set(shared::kBindVisible, visible_);
  bindings.set(shared::kBindCounts, counts_);
  // Without a map it is unread, but see BindingSet.
  bindings.set(shared::kBindStore, map_ ? *map_ : samples.visibility, nearest_);
}

void Frame::look(const FrameView& view) {
  view_.light = view.light;
  view_.origin = view.origin;
  view_.constants = view.constants;
  *constants_.mapped<shared::FrameConstants>() = constantsOf(view, method_);
}

std::vector<Pass> Frame::passes() const {
  const auto on = [this](void (Frame::*pass)(VkCommandBuffer) const) {
    return [this, pass](VkCommandBuffer command) { (this->*pass)(command); };
  };
  if (method_.row->technique == Technique::rayTraced)
    return {{.name = "gbuffer", .record = on(&Frame::gbuffer)},
            {.name = "readback", .record = on(&Frame::readSamples)},
            {.name = "trace", .host = [this] { trace(); }, .rays = pixels(view_)},
            {.name = "resolve", .record = on(&Frame::takeVisibility)},
            {.name = "shade", .record = on(&Frame::shade)}};
  return {{.name = "gbuffer", .record = on(&Frame::gbuffer)},
          {.name = "analyze", .record = on(&Frame::analyze)},
          {.name = "plan", .record = on(&Frame::plan)},
          {.name = "cull", .record = [this](VkCommandBuffer command) { cull(command, 1, shadowViews_); }},
          {.name = "store", .record = on(&Frame::store)},
          {.name = "resolve", .record = on(&Frame::resolve)},
          {.name = "shade", .record = on(&Frame::shade)}};
}

// What the camera sees: the clusters that reach its frustum, their ids and depth, then the view samples.
void Frame::gbuffer(VkCommandBuffer command) const {
  cull(command, shared::kCameraSlot, 1);
  bindings_.bind(command);
  renderInto(command, {&view_.target.ids}, &view_.target.depth, [&] {
    drawSlot(command, shared::kCameraSlot, view_.pipelines.gbuffer, view_.pipelines.gbufferMasked, true);
  });
  renderInto(command, {&view_.target.positions, &view_.target.normals}, nullptr, [&] {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS, view_.pipelines.samples);
    vkCmdDraw(command, 3, 1, 0, 0);
  });
}

// What the view samples say about the volume; nothing to do where the host knows it.
void Frame::analyze(VkCommandBuffer command) const {
  if (method_.stages->volume != Volume::samples) return;
  bindings_.bind(command);
  const VkDeviceSize maxOffset = offsetof(shared::Analysis, lsBoundsMax);
  vkCmdFillBuffer(command, analysis_, 0, maxOffset, 0xffffffffu);
  vkCmdFillBuffer(command, analysis_, maxOffset, sizeof(shared::Analysis) - maxOffset, 0);
  barrier(command);
  vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, view_.pipelines.analyzeBounds);
  vkCmdDispatch(command, groups(static_cast<std::uint32_t>(pixels(view_)), 64 * 16), 1, 1);
  barrier(command);
}

// Where each map lies and what it covers.
void Frame::plan(VkCommandBuffer command) const {
  bindings_.bind(command);
  vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE,
                    view_.pipelines.planSingle.at(method_.stages->volume));
  vkCmdDispatch(command, 1, 1, 1);
  barrier(command);
}

// Which clusters reach each of these views.
void Frame::cull(VkCommandBuffer command, std::uint32_t firstSlot, std::uint32_t slots) const {
  const std::uint32_t chunks = view_.scene.drawCount() / shared::kDrawsPerChunk;
  if (chunks == 0) return;
  bindings_.bind(command);
  push(command, firstSlot);
  for (const VkPipeline pipeline :
       {VkPipeline(view_.pipelines.cullTest), VkPipeline(view_.pipelines.cullWrite)}) {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdDispatch(command, groups(chunks, 64), slots, 1);
    barrier(command);
  }
}

// The shadow maps.
void Frame::store(VkCommandBuffer command) const {
  bindings_.bind(command);
  renderInto(command, {}, &*map_, [&] {
    for (std::uint32_t v = 0; v < shadowViews_; ++v) {
      push(command, v);
      drawSlot(command, 1 + v, view_.pipelines.storeDepth, view_.pipelines.storeDepthMasked, false);
    }
  });
}

// How lit each view sample is.
void Frame::resolve(VkCommandBuffer command) const { recordLookup(command, view_.target, bindings_); }

BindingSet Frame::bindingsAt(const ViewTarget& points) const {
  BindingSet bindings(view_.device, view_.pipelines.layout);
  bindTo(bindings, points);
  return bindings;
}

void Frame::recordLookup(VkCommandBuffer command, const ViewTarget& points,
                         const BindingSet& bindings) const {
  bindings.bind(command);
  renderInto(command, {&points.visibility}, nullptr, [&] {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      view_.pipelines.resolve.at(method_.stages->lookup));
    vkCmdDraw(command, 3, 1, 0, 0);
  });
}

// The picture.
void Frame::shade(VkCommandBuffer command) const {
  bindings_.bind(command);
  renderInto(command, {&view_.target.colour}, nullptr, [&] {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      view_.scene.plainColours() ? view_.pipelines.shadePlain : view_.pipelines.shade);
    vkCmdDraw(command, 3, 1, 0, 0);
  });
}

void Frame::readSamples(VkCommandBuffer command) const {
  for (const auto& [image, buffer] : {std::pair(&view_.target.positions, &*hostPositions_),
                                      std::pair(&view_.target.normals, &*hostNormals_)})
    copyToBuffer(command, *image, *buffer);
}

void Frame::trace() const {
  std::vector<shared::ViewSample> samples(pixels(view_));
  gatherSamples(hostPositions_->mapped<glm::uvec4>(), hostNormals_->mapped<glm::uvec4>(), samples);
  view_.reference->trace(samples, view_.light, view_.origin,
                         {hostVisibility_->mapped<float>(), static_cast<std::size_t>(pixels(view_))},
                         view_.constants.imageSize.x);
}

void Frame::takeVisibility(VkCommandBuffer command) const {
  copyToImage(command, *hostVisibility_, view_.target.visibility);
}

void Frame::recordAnswers(VkCommandBuffer command) const {
  bindings_.bind(command);
  renderInto(command, {&view_.target.answers}, nullptr, [&] {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS, view_.pipelines.answers);
    vkCmdDraw(command, 3, 1, 0, 0);
  });
}

void Frame::drawSlot(VkCommandBuffer command, std::uint32_t slot, VkPipeline opaque, VkPipeline masked,
                     bool cullFaces) const {
  constexpr VkCullModeFlags kNone = VK_CULL_MODE_NONE;
  constexpr VkCullModeFlags kCullModes[] = {kNone, VK_CULL_MODE_BACK_BIT, VK_CULL_MODE_FRONT_BIT};
  for (std::uint32_t bucket = 0; bucket < shared::kBuckets; ++bucket) {
    const auto [firstChunk, chunks] =
        std::pair(view_.scene.buckets()[bucket].x, view_.scene.buckets()[bucket].y);
    if (chunks == 0) continue;
    const bool isMasked = bucket >= shared::kFirstMaskedBucket;
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS, isMasked ? masked : opaque);
    vkCmdSetCullMode(command, cullFaces ? kCullModes[bucket % shared::kFirstMaskedBucket] : kNone);
    view_.scene.bindVertices(command, isMasked);
    const VkDeviceSize first =
        VkDeviceSize{slot} * view_.scene.drawCount() + firstChunk * shared::kDrawsPerChunk;
    vkCmdDrawIndexedIndirectCount(command, commands_, first * sizeof(shared::DrawCommand), counts_,
                                  (slot * shared::kBuckets + bucket) * sizeof(std::uint32_t),
                                  chunks * shared::kDrawsPerChunk, sizeof(shared::DrawCommand));
  }
}

void Frame::push(VkCommandBuffer command, std::uint32_t value) const {
  vkCmdPushConstants(command, view_.pipelines.layout.pipeline(), VK_SHADER_STAGE_ALL, 0, sizeof value,
                     &value);
}

shared::Plan Frame::downloadPlan() const {
  shared::Plan plan{};
  if (!method_.stages) return plan;
  const std::vector<std::byte> bytes = downloaded(view_.device, plan_);
  std::memcpy(&plan, bytes.data(), sizeof plan);
  return plan;
}

std::uint64_t Frame::storeTexels() const {
  return map_ ? std::uint64_t{map_->extent().width} * map_->extent().height : 0;
}

std::uint64_t Frame::storeBytes() const { return storeTexels() * sizeof(float); }

std::uint64_t Frame::totalBytes() const {
  std::uint64_t bytes = storeBytes();
  if (method_.stages)
    bytes += analysis_.size() + plan_.size() + commands_.size() + visible_.size() + counts_.size();
  for (const auto* buffer : {&hostPositions_, &hostNormals_, &hostVisibility_})
    if (*buffer) bytes += (*buffer)->size();
  return bytes;
}

void gatherSamples(const glm::uvec4* positions, const glm::uvec4* normals,
                   std::span<shared::ViewSample> samples) {
  static_assert(sizeof(shared::ViewSample) == 2 * sizeof(glm::uvec4));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::memcpy(&samples[i], &positions[i], sizeof(glm::uvec4));
    std::memcpy(&samples[i].wsNormal, &normals[i], sizeof(glm::uvec4));
  }
}

}  // namespace sundial
