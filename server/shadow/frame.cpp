#include "shadow/frame.h"

#include "gpu/rendering.h"
#include "shadow/cube_faces.h"
#include "shadow/minimal_frustum.h"
#include "shadow/plan_settings.h"
#include "shared/bindings.h"
#include "shared/samples.h"

namespace sundial {

namespace {

constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
constexpr VkBufferUsageFlags kIndirect = kStorage | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
constexpr VkBufferUsageFlags kCopied = VK_BUFFER_USAGE_TRANSFER_SRC_BIT;

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
  c.biasTexels = static_cast<float>(settings.biasTexels);
  c.biasWorld =
      static_cast<float>(settings.biasWorld.value_or(kBiasOfDiagonal * view.scene.scene().bounds.diagonal()));
  c.pcfKernel = settings.kernel;
  settle(c, method, view.origin);
  return c;
}

VkDeviceSize pixels(const FrameView& view) {
  return VkDeviceSize{view.constants.imageSize.x} * view.constants.imageSize.y;
}

}  // namespace

Frame::Frame(const FrameView& view, const Method& method, MakeStore* make)
    : view_(view),
      method_(withRaster(method, view.device, view.scene.scene().instancedTriangles())),
      shadowViews_(method.row->technique == Technique::shadowVolumes ? 1 : shadowViewsOf(method)),
      pipelines_(method.stages ? std::optional(view.pipelines.of(method_, view.scene.hasHoles()))
                               : std::nullopt),
      constants_(view.device, sizeof(shared::FrameConstants), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | kCopied,
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
      unread_(unreadBuffer(view.device)),
      bindings_(view.device, view.pipelines.layout) {
  const shared::FrameConstants constants = settledConstants();
  *constants_.mapped<shared::FrameConstants>() = constants;
  if (method.stages) {
    store_ = make(view.device, view.pipelines, method_, constants);
    if (method.stages->warp != Warp::none) warp_.emplace(view.device, view.pipelines, method_, constants);
    if (method.settings.plan == PlanTiming::readback) {
      hostPlan_.emplace(view.device, sizeof(shared::Plan), 0, MemoryUse::readback);
      hostCommands_.emplace(view.device,
                            VkDeviceSize{view.scene.drawCount()} * shadowViews_ * sizeof(shared::DrawCommand),
                            kIndirect, MemoryUse::upload);
      hostCounts_.emplace(view.device, shadowViews_ * shared::kBuckets * sizeof(std::uint32_t), kIndirect,
                          MemoryUse::upload);
    }
  } else if (method.row->technique == Technique::shadowVolumes) {
    volumes_.emplace(view.device, view.pipelines, *view.edges, view.constants.imageSize);
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
  bindings.set(shared::kBindSilhouette, analysis_);
  bindings.set(shared::kBindTables, view_.pipelines.tables);
  // Unread, unless a store has triangles.
  for (const std::uint32_t binding : {shared::kBindHeld, shared::kBindHeldWritten})
    bindings.set(binding, unread_);
  if (volumes_) return volumes_->bindTo(bindings);
  if (!store_) return bindNoStore(bindings, samples.visibility, nearest_, unread_);
  store_->bindTo(bindings);
  if (walksSurfaces(method_)) view_.scene.bindAdjacent(view_.device, bindings);
  if (warp_) warp_->bindTo(bindings);
}

void Frame::look(const FrameView& view) {
  view_.light = view.light;
  view_.origin = view.origin;
  view_.constants = view.constants;
  *constants_.mapped<shared::FrameConstants>() = settledConstants();
}

// With what a cube's faces hold of the scene.
shared::FrameConstants Frame::settledConstants() {
  shared::FrameConstants c = constantsOf(view_, method_);
  if (method_.stages && method_.stages->partition == Partition::cube)
    fitFaces(c, method_, clusters().boxes());
  return c;
}

const PlacedClusters& Frame::clusters() {
  if (!clusters_ || clusters_->origin() != view_.origin) clusters_.emplace(view_.scene, view_.origin);
  return *clusters_;
}

std::vector<Pass> Frame::passes() {
  const auto on = [this](void (Frame::*pass)(VkCommandBuffer) const) {
    return [this, pass](VkCommandBuffer command) { (this->*pass)(command); };
  };
  const Pass gbuffer{.name = "gbuffer", .record = on(&Frame::gbuffer)};
  const Pass shade{.name = "shade", .record = on(&Frame::shade)};
  if (method_.row->technique == Technique::rayTraced)
    return {gbuffer,
            {.name = "readback", .record = on(&Frame::readSamples)},
            {.name = "trace", .host = [this] { trace(); }, .rays = pixels(view_)},
            {.name = "resolve", .record = on(&Frame::takeVisibility)},
            shade};
  if (volumes_)
    return {gbuffer,
            {.name = "volumes", .record = on(&Frame::countVolumes)},
            {.name = "resolve", .record = on(&Frame::resolveVolumes)},
            shade};

  const Pass analyze{.name = "analyze", .record = on(&Frame::analyze)};
  const Pass plan{.name = "plan", .record = on(&Frame::plan)};
  const bool looks =
      warp_ && method_.stages->warp == Warp::rectilinear && method_.settings.analysis != Analysis::backward;
  const Pass light = looks ? Pass{.name = "light",
                                  .record = on(&Frame::drawUnwarped),
                                  .again = [this] { return storeAgain(); },
                                  .counted = [this] { return storeWork(); }}
                           : Pass{};
  const Pass warp = warp_ ? Pass{.name = "warp", .record = on(&Frame::warp)} : Pass{};
  const Pass cull{.name = "cull",
                  .record = [this](VkCommandBuffer command) { this->cull(command, 1, shadowViews_); }};
  const Pass store{.name = "store",
                   .record = on(&Frame::store),
                   .again = [this] { return storeAgain(); },
                   .counted = [this] { return storeWork(); }};
  const Pass filter{.name = store_->filterName(), .record = on(&Frame::filter)};
  const Pass resolve{.name = "resolve", .record = on(&Frame::resolve)};
  std::vector<Pass> passes = [&]() -> std::vector<Pass> {
    switch (method_.settings.plan) {
      case PlanTiming::readback:
        return {gbuffer,
                analyze,
                plan,
                {.name = "readback", .record = on(&Frame::readPlan)},
                {.name = "cull",
                 .host =
                     [this] {
                       cullByHost();
                       fitStore();
                     }},
                light,
                warp,
                store,
                filter,
                resolve,
                shade};
      case PlanTiming::delayed:
        // What was analysed lies relative to its origin.
        if (analysedAt_ == view_.origin)
          return {gbuffer, plan, cull, light, warp, store, filter, resolve, shade, analyze};
        [[fallthrough]];
      case PlanTiming::gpu:
        return {gbuffer, analyze, plan, cull, light, warp, store, filter, resolve, shade};
    }
    return {};
  }();
  if (method_.stages->focus == Focus::calipers)
    passes.insert(passes.begin(), {.name = "fit", .host = [this] { fit(); }});
  std::erase_if(passes, [](const Pass& pass) { return pass.name.empty(); });
  return passes;
}

// What the camera could see, in the light's frustum.
void Frame::fit() {
  shared::FrameConstants fitted = settledConstants();
  if (method_.stages->partition == Partition::cube)
    fitMinimalFaces(fitted, clusters());
  else
    fitMinimalFrustum(fitted, clusters());
  *constants_.mapped<shared::FrameConstants>() = fitted;
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

// What the view samples say about the volume and its parts; nothing where the host knows the volume, but for
// where the camera's depth is cut.
void Frame::analyze(VkCommandBuffer command) const {
  const Stages& stages = *method_.stages;
  analysedAt_ = view_.origin;
  bindings_.bind(command);
  if (asksSamples(stages)) {
    const VkBufferCopy axes{offsetof(shared::FrameConstants, lightFromWorld),
                            offsetof(shared::Analysis, lightFromWorld), sizeof(glm::mat4)};
    vkCmdCopyBuffer(command, constants_, analysis_, 1, &axes);
    constexpr VkDeviceSize kOnes = offsetof(shared::Analysis, depthMin),
                           kZeros = offsetof(shared::Analysis, depthMax);
    vkCmdFillBuffer(command, analysis_, kOnes, kZeros - kOnes, 0xffffffffu);
    const VkDeviceSize zerosEnd = method_.settings.percentile > 0
                                      ? sizeof(shared::Analysis)
                                      : offsetof(shared::Analysis, pixelHistogram);
    vkCmdFillBuffer(command, analysis_, kZeros, zerosEnd - kZeros, 0);
    barrier(command);
  }
  const std::uint32_t samples =
      groups(static_cast<std::uint32_t>(pixels(view_)), shared::kSampleGroup * shared::kSamplesPerInvocation);
  if (cutsDepth(stages.partition)) {
    if (stages.volume == Volume::samples && stages.partition != Partition::manual)
      dispatch(command, pipelines_->analyzeDepths, samples);
    dispatch(command, pipelines_->analyzeSplits, 1);
  }
  if (asksNearness(method_)) dispatch(command, pipelines_->analyzeDepths, samples);
  const bool tiles = stages.partition == Partition::tiles;
  const bool estimated = stages.resolution == Resolution::estimated;
  if (tiles && !method_.settings.extent) dispatch(command, pipelines_->analyzeSquare, samples);
  if (asksSamples(stages) && (tiles || estimated || stages.focus != Focus::loose))
    dispatch(command, pipelines_->analyzeSegments, samples);
  if (estimated && method_.settings.percentile > 0)
    dispatch(command, pipelines_->analyzeSizes, groups(samples, shared::kPixelsPerMeasured));
  if (tiles && stages.focus == Focus::loose)
    dispatch(command, pipelines_->analyzeCasters, groups(view_.scene.drawCount(), 64));
}

// Where each map lies and what it covers.
void Frame::plan(VkCommandBuffer command) const {
  bindings_.bind(command);
  dispatch(command, pipelines_->plan, 1);
}

// What the light sees, in a map without a warp.
void Frame::drawUnwarped(VkCommandBuffer command) const {
  bindings_.bind(command);
  warp_->recordNone(command);
  store(command);
}

// How the maps are re-parameterised.
void Frame::warp(VkCommandBuffer command) const {
  bindings_.bind(command);
  warp_->record(command);
}

void Frame::dispatch(VkCommandBuffer command, VkPipeline pipeline, std::uint32_t groups) const {
  vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  vkCmdDispatch(command, groups, 1, 1);
  barrier(command);
}

void Frame::readPlan(VkCommandBuffer command) const {
  const VkBufferCopy all{0, 0, sizeof(shared::Plan)};
  vkCmdCopyBuffer(command, plan_, *hostPlan_, 1, &all);
  barrier(command);
}

void Frame::cullByHost() const {
  const std::size_t views = shadowViews_;
  cullOnHost(view_.scene, view_.origin, *hostPlan_->mapped<shared::Plan>(), !method_.settings.cull,
             {hostCommands_->mapped<shared::DrawCommand>(), views * view_.scene.drawCount()},
             {hostCounts_->mapped<std::uint32_t>(), views * shared::kBuckets});
}

// Memory for the maps that the plan asks for.
void Frame::fitStore() {
  if (method_.stages->resolution != Resolution::estimated) return;
  store_->fit(*hostPlan_->mapped<shared::Plan>());
  store_->bindTo(bindings_);
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
  if (hostCommands_) takeHostDraws(command);
  bindings_.bind(command);
  const auto [opaque, masked] =
      store_->pipelines().value_or(std::array{pipelines_->store, pipelines_->storeMasked});
  store_->record(command, [&](std::uint32_t view) {
    push(command, view);
    drawSlot(command, 1 + view, opaque, masked, false);
  });
}

bool Frame::storeAgain() {
  if (!store_->again()) return false;
  bindTo(bindings_, view_.target);
  return true;
}

std::vector<Work> Frame::storeWork() const {
  std::vector<Work> work = store_->work();
  work.push_back({"by_compute", drawsByCompute() ? 1.0 : 0.0});
  return work;
}

// What the host left, in the place of what culling on the device would have.
void Frame::takeHostDraws(VkCommandBuffer command) const {
  const VkBufferCopy commands{0, VkDeviceSize{view_.scene.drawCount()} * sizeof(shared::DrawCommand),
                              hostCommands_->size()};
  const VkBufferCopy counts{0, shared::kBuckets * sizeof(std::uint32_t), hostCounts_->size()};
  if (view_.scene.drawCount() > 0) vkCmdCopyBuffer(command, *hostCommands_, commands_, 1, &commands);
  vkCmdCopyBuffer(command, *hostCounts_, counts_, 1, &counts);
  barrier(command);
}

// What the maps' lookup needs beyond them.
void Frame::filter(VkCommandBuffer command) const {
  bindings_.bind(command);
  store_->filter(command);
  store_->gather(command, static_cast<std::uint32_t>(pixels(view_)));
}

// How lit each view sample is.
void Frame::resolve(VkCommandBuffer command) const {
  bindings_.bind(command);
  lookUp(command, view_.target);
}

BindingSet Frame::bindingsAt(const ViewTarget& points) const {
  BindingSet bindings(view_.device, view_.pipelines.layout);
  bindTo(bindings, points);
  return bindings;
}

void Frame::recordLookup(VkCommandBuffer command, const ViewTarget& points,
                         const BindingSet& bindings) const {
  bindings.bind(command);
  store_->gather(command, points.size().x * points.size().y);
  lookUp(command, points);
}

void Frame::lookUp(VkCommandBuffer command, const ViewTarget& points) const {
  const auto draw = [&](VkPipeline pipeline) {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdDraw(command, 3, 1, 0, 0);
  };
  if (!pipelines_->resolveFirst) {
    renderInto(command, {&points.visibility}, nullptr, [&] { draw(pipelines_->resolve); });
    return;
  }
  renderInto(command, {&points.visibility}, &points.undecided, [&] { draw(pipelines_->resolveFirst); });
  store_->gatherMore(command);
  renderOnto(command, {&points.visibility}, &points.undecided, [&] {
    // Between what is decided, at 1, and what isn't, at 0.
    const auto [width, height] = points.visibility.extent();
    const VkViewport between{0, 0, static_cast<float>(width), static_cast<float>(height), 0.5f, 0.5f};
    vkCmdSetViewport(command, 0, 1, &between);
    draw(pipelines_->resolve);
  });
}

void Frame::recordClasses(VkCommandBuffer command) const {
  bindings_.bind(command);
  renderInto(command, {&view_.target.visibility}, nullptr, [&] {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      view_.pipelines.classify(method_, view_.scene.hasHoles()));
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

void Frame::recordAnswers(VkCommandBuffer command) const {
  bindings_.bind(command);
  renderInto(command, {&view_.target.answers}, nullptr, [&] {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_->answers);
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

}  // namespace sundial
