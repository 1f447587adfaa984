#include "shadow/moment_store.h"

#include <cmath>

#include "gpu/rendering.h"
#include "shadow/plan_settings.h"
#include "shared/bindings.h"

namespace sundial {

namespace {

constexpr VkImageUsageFlags kDrawnAndRead = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
constexpr VkImageUsageFlags kCopied = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

// Of the scene in light space, metres.
struct Extent {
  double near = 0, far = 1;  // along the light
  double size = 1;
};

Extent extentOf(const shared::FrameConstants& c) {
  const glm::dvec3 low(c.lsBoundsMin), high(c.lsBoundsMax);
  if (low.x > high.x) return {};
  if (c.lightKind != shared::kLightDirectional) return {1 / high.z, 1 / low.z, 1 / low.z};
  return {-high.z, -low.z, std::max(glm::length(high - low), 1e-6)};
}

}  // namespace

void settleMoments(shared::FrameConstants& c, const Method& method) {
  const Method::Settings& from = method.settings;
  const Extent scene = extentOf(c);
  const bool placed = c.lightKind != shared::kLightDirectional;
  c.moments = {.exponents = {from.exponents.front(), from.exponents.back()},
               .leastDeviation = static_cast<float>(from.leastDeviation.value_or(2e-5 * scene.size)),
               .anisotropy = static_cast<float>(from.anisotropy),
               .bleedReduction = static_cast<float>(from.bleedReduction),
               .lsBlur = static_cast<float>(from.blur / (placed ? 0.5 * (scene.near + scene.far) : 1))};
  // With room behind: where nothing is drawn a map must be farther than all ground whose slope the filter
  // follows there.
  const double far = scene.far + 0.1 * scene.size;
  c.settings.lsFar = static_cast<float>(placed ? 1 / far : -far);
  c.settings.lsReach = 0.5f * c.moments.lsBlur;
  c.settings.rimTexels = 1;  // linear filtering's
}

MomentStore::MomentStore(const Device& device, FramePipelines& pipelines, const Method& method,
                         const shared::FrameConstants& constants)
    : layout_(pipelines.layout.pipeline()),
      pipelines_(pipelines.of(method)),
      views_(shadowViewsOf(method)),
      blurs_(constants.moments.lsBlur > 0),
      unread_(unreadBuffer(device)),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)),
      level_(makeLevelSampler(device)) {
  const VkExtent2D map{constants.settings.mapSize.x, constants.settings.mapSize.y};
  constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  depth_ = GpuImage(device, map, VK_FORMAT_D32_SFLOAT,
                    VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                    {.samples = VK_SAMPLE_COUNT_4_BIT});
  moments_ = GpuImage(device, map, kFormat, kDrawnAndRead | kCopied,
                      {.layers = views_, .array = true, .levels = levelsOf(map)});
  blurred_ = GpuImage(device, blurs_ ? map : VkExtent2D{1, 1}, kFormat, kDrawnAndRead, {.array = true});
  device.submit([&](VkCommandBuffer command) {
    for (const GpuImage* image : {&depth_, &moments_, &blurred_})
      transition(command, *image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

void MomentStore::record(VkCommandBuffer command, const DrawView& draw) const {
  for (std::uint32_t view = 0; view < views_; ++view) {
    renderInto(command, {}, &depth_, [&] { draw(view); });
    drawFullscreen(command, moments_, view, pipelines_.moments, view);
  }
}

void MomentStore::filter(VkCommandBuffer command) const {
  for (std::uint32_t view = 0; blurs_ && view < views_; ++view) {
    drawFullscreen(command, blurred_, 0, pipelines_.blurAcross, view);
    drawFullscreen(command, moments_, view, pipelines_.blurDown, view);
  }
  fillLevels(command, moments_);
}

void MomentStore::drawFullscreen(VkCommandBuffer command, const GpuImage& array, std::uint32_t layer,
                                 VkPipeline pipeline, std::uint32_t view) const {
  vkCmdPushConstants(command, layout_, VK_SHADER_STAGE_ALL, 0, sizeof view, &view);
  renderIntoLayer(command, array, layer, [&] {
    vkCmdBindPipeline(command, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdDraw(command, 3, 1, 0, 0);
  });
}

void MomentStore::bindTo(BindingSet& bindings) const {
  bindNoStore(bindings, blurred_, nearest_, unread_);
  bindings.set(shared::kBindMultisampled, depth_, nearest_);
  bindings.set(shared::kBindMoments, moments_, level_);
  bindings.set(shared::kBindBlurred, blurred_, nearest_);
}

std::uint64_t MomentStore::texels() const {
  return std::uint64_t{views_} * moments_.extent().width * moments_.extent().height;
}

}  // namespace sundial
