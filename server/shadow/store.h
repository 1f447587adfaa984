// The memory that holds a frame's shadow maps, and how they get there: one class a choice of storage.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "gpu/pipeline.h"
#include "shadow/method.h"
#include "shared/frame.h"
#include "work.h"

namespace sundial {

class FramePipelines;

// Why this device can't hold the method's maps; nothing if it can, or if the method has none.
std::optional<std::string> whyTooLarge(const Method&, const Device&);

class Store {
 public:
  using DrawView = std::function<void(std::uint32_t view)>;

  Store() = default;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;
  virtual ~Store() = default;

  // Clears all maps, and draws all views: by `draw`, with viewport and scissor set to the view's map, or by
  // compute.
  virtual void record(VkCommandBuffer, const DrawView& draw) const = 0;
  // What `draw` draws opaque and masked triangles with, where it isn't the method's pipelines.
  virtual std::optional<std::array<VkPipeline, 2>> pipelines() const { return std::nullopt; }
  // Whether recorded work, now done, left something out: then there is room for it, and bindings are to be
  // set and the maps recorded once more.
  virtual bool again() { return false; }
  // What the device's statistics don't know of the recorded work, now done.
  virtual std::vector<Work> work() const { return {}; }
  // Makes of drawn maps what lookups read, in a pass of its own.
  virtual std::string_view filterName() const { return {}; }  // empty: there is none
  virtual void filter(VkCommandBuffer) const {}
  // The rest of that, for the lookups of so many view samples, which are bound; and, between the two rounds
  // of a lookup, for the second.
  virtual void gather(VkCommandBuffer, std::uint32_t /*samples*/) const {}
  virtual void gatherMore(VkCommandBuffer) const {}
  // Takes the memory that this plan needs, where sizes are the plan's: what was bound before is gone.
  virtual void fit(const shared::Plan&) {}
  virtual void bindTo(BindingSet&) const = 0;
  // The depths of all maps as they lie in the store: texel by texel of answers.frag. Empty where it holds
  // none.
  virtual std::vector<float> depths() const { return {}; }
  virtual std::uint64_t texels() const = 0;  // that there is memory for
  virtual std::uint64_t bytes() const = 0;   // of memory
};

// Of a method with a map; `constants` are settled (plan_settings.h).
std::unique_ptr<Store> makeStore(const Device&, FramePipelines&, const Method&,
                                 const shared::FrameConstants&);
using MakeStore = decltype(makeStore);

// Where each view's map lies in an image that holds all, mapColumnsOf() in a row; in a buffer each begins at
// 0, 0.
std::vector<VkRect2D> mapsOf(const Method&);
std::uint64_t texelsOf(const shared::Plan&);
// Draws each view into its map.
void drawMaps(VkCommandBuffer, const std::vector<VkRect2D>& maps, const Store::DrawView& draw);
// The same where maps are parts of one viewport that the plan knows: nothing is drawn beside `extent`.
void drawPlaced(VkCommandBuffer, const glm::uvec2& viewport, VkExtent2D extent, std::uint32_t views,
                const Store::DrawView& draw);

// What a store, or a frame without one, has nothing for: see BindingSet.
void bindNoStore(BindingSet&, const GpuImage& unread, VkSampler, const TexelBuffer& unreadToo);
TexelBuffer unreadBuffer(const Device&);

}  // namespace sundial
