// One frame of one method: the list of its passes, and the memory that they need.
#pragma once

#include <functional>
#include <memory>

#include "reference/reference.h"
#include "shadow/frame_pipelines.h"
#include "shadow/method.h"
#include "shadow/placed_clusters.h"
#include "shadow/raster_choice.h"
#include "shadow/scene_buffers.h"
#include "shadow/shadow_volumes.h"
#include "shadow/store.h"
#include "shadow/view_target.h"
#include "shadow/warp_maps.h"
#include "shared/plan.h"
#include "work.h"

namespace sundial {

// A step of the frame, on the device or on the host.
struct Pass {
  std::string_view name;
  std::function<void(VkCommandBuffer)> record;  // device work, or
  std::function<void()> host;                   // host work, done when all earlier passes are
  std::uint64_t rays = 0;                       // traced by a host pass
  // When device work is done: whether it must be recorded again, and what it counted beside the device's
  // statistics.
  std::function<bool()> again = {};
  std::function<std::vector<Work>()> counted = {};
};

// What all methods that render one view share.
struct FrameView {
  const Device& device;
  FramePipelines& pipelines;
  const SceneBuffers& scene;
  const ViewTarget& target;
  const Reference* reference;  // for Technique::rayTraced
  const EdgeBuffers* edges;    // for Technique::shadowVolumes
  Light light;
  glm::dvec3 origin;                 // world position of GPU coordinates' zero
  shared::FrameConstants constants;  // frameConstants()
};

class Frame {
 public:
  // `make` is another way to keep the maps: of benchmarks.
  Frame(const FrameView&, const Method&, MakeStore* make = makeStore);
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  // In the order of execution. With plan=delayed the first frame asks its own samples, before it plans; all
  // frames ask theirs at the end, for the frame after.
  std::vector<Pass> passes();
  // The next frame, from elsewhere or in other light: a view of the same scene, size and target.
  void look(const FrameView&);
  // The lookup at other samples than the view's, for methods with a map, after the passes before `resolve`:
  // `points` holds the samples and gets their visibility. `bindings` are bindingsAt(points).
  BindingSet bindingsAt(const ViewTarget& points) const;
  void recordLookup(VkCommandBuffer, const ViewTarget& points, const BindingSet& bindings) const;
  // What answered each sample, into the target's `answers`; for methods with a map, after the passes.
  void recordAnswers(VkCommandBuffer) const;
  // With lookup=spsm: what each sample's answer was found from (shared/choices.h: kAnswer...), into the
  // target's `visibility`; after all else.
  void recordClasses(VkCommandBuffer) const;

  bool drawsByCompute() const { return isLinear(method_); }
  shared::Plan downloadPlan() const;          // viewCount 0 for methods without a map
  WarpTables downloadWarp() const;            // empty without a warp
  std::vector<float> downloadDepths() const;  // Store::depths()
  std::uint64_t storeTexels() const;          // that there is memory for
  std::uint64_t storeBytes() const;
  std::uint64_t usedStoreBytes(const shared::Plan&) const;  // less, where a plan on the device sizes the maps
  std::uint64_t otherBytes() const;  // the plan, the lists of culling and what analysis needs

 private:
  shared::FrameConstants settledConstants();
  const PlacedClusters& clusters();
  void fit();
  void gbuffer(VkCommandBuffer) const;
  void analyze(VkCommandBuffer) const;
  void plan(VkCommandBuffer) const;
  void drawUnwarped(VkCommandBuffer) const;
  void warp(VkCommandBuffer) const;
  void cull(VkCommandBuffer, std::uint32_t firstSlot, std::uint32_t slots) const;
  void readPlan(VkCommandBuffer) const;
  void takeHostDraws(VkCommandBuffer) const;
  void cullByHost() const;
  void fitStore();
  void store(VkCommandBuffer) const;
  bool storeAgain();
  std::vector<Work> storeWork() const;
  void filter(VkCommandBuffer) const;
  void resolve(VkCommandBuffer) const;
  void lookUp(VkCommandBuffer, const ViewTarget& points) const;  // whose bindings are bound
  void shade(VkCommandBuffer) const;
  void readSamples(VkCommandBuffer) const;
  void trace() const;
  void takeVisibility(VkCommandBuffer) const;
  void countVolumes(VkCommandBuffer) const;
  void cullFarCaps(VkCommandBuffer) const;
  void resolveVolumes(VkCommandBuffer) const;

  void bindTo(BindingSet&, const ViewTarget& samples) const;
  void dispatch(VkCommandBuffer, VkPipeline, std::uint32_t groups) const;
  void drawSlot(VkCommandBuffer, std::uint32_t slot, VkPipeline opaque, VkPipeline masked,
                bool cullFaces) const;
  void push(VkCommandBuffer, std::uint32_t) const;

  FrameView view_;
  Method method_;
  std::uint32_t shadowViews_;                 // the plan's most; of shadow volumes the one of their far caps
  std::optional<MethodPipelines> pipelines_;  // with a map
  Buffer constants_, analysis_, plan_, commands_, visible_, counts_;
  std::unique_ptr<Store> store_;  // with a map
  std::optional<WarpMaps> warp_;
  Sampler nearest_;
  TexelBuffer unread_;
  BindingSet bindings_;
  // plan=readback alone: the plan on its way to the host, and what the host leaves of the draws.
  std::optional<Buffer> hostPlan_, hostCommands_, hostCounts_;
  // focus=calipers and partition=cube alone: the scene's clusters.
  std::optional<PlacedClusters> clusters_;
  mutable std::optional<glm::dvec3> analysedAt_;  // the origin of the last analysis that was recorded
  std::optional<ShadowVolumes> volumes_;
  // Ray tracing alone: view samples on their way to the host, visibility on its way back.
  std::optional<Buffer> hostPositions_, hostNormals_, hostVisibility_;
};

// An image pair as the target holds it, put together: one ViewSample a pixel.
void gatherSamples(const glm::uvec4* positions, const glm::uvec4* normals, std::span<shared::ViewSample>);

}  // namespace sundial
