#include "shadow/frame_pipelines.h"

#include <fmt/format.h>

#include "shadow/lookup_tables.h"
#include "shadow/plan_settings.h"
#include "shadow/raster_choice.h"
#include "shadow/scene_buffers.h"
#include "shared/choices.h"

namespace sundial {

namespace {

GraphicsPipelineInfo geometry(std::string_view vertex, std::string_view fragment, bool masked) {
  return {.vertexShader = vertex,
          .fragmentShader = fragment,
          .vertexBindings = SceneBuffers::vertexBindings(masked),
          .vertexAttributes = SceneBuffers::vertexAttributes(false, masked)};
}

GraphicsPipelineInfo gbufferOf(std::string_view vertex, std::string_view fragment, bool masked) {
  GraphicsPipelineInfo info = geometry(vertex, fragment, masked);
  info.vertexAttributes = SceneBuffers::vertexAttributes(true, masked);
  info.colourFormats = {VK_FORMAT_R32G32_UINT};
  info.depth = true;
  return info;
}

GraphicsPipelineInfo storeOf(std::string_view vertex, std::string_view fragment, bool masked) {
  GraphicsPipelineInfo info = geometry(vertex, fragment, masked);
  info.depth = true;
  info.depthClamp = true;
  return info;
}

// Into four samples a texel.
GraphicsPipelineInfo multisampledOf(std::string_view vertex, std::string_view fragment, bool masked) {
  GraphicsPipelineInfo info = storeOf(vertex, fragment, masked);
  info.samples = VK_SAMPLE_COUNT_4_BIT;
  return info;
}

GraphicsPipelineInfo clearOf() {
  return {.vertexShader = "store_clear.vert", .fragmentShader = "", .depth = true, .depthAlways = true};
}

GraphicsPipelineInfo fullscreenOf(std::string_view fragment, std::vector<VkFormat> formats,
                                  Specialization specialization = {}) {
  return {.vertexShader = "fullscreen.vert",
          .fragmentShader = fragment,
          .specialization = std::move(specialization),
          .colourFormats = std::move(formats)};
}

// The constants of the shaders, by the stages' choices.

std::uint32_t cutOf(Partition partition) {
  switch (partition) {
    case Partition::manual:
      return shared::kCutManual;
    case Partition::uniform:
      return shared::kCutUniform;
    case Partition::practical:
      return shared::kCutPractical;
    case Partition::adaptive:
      return shared::kCutAdaptive;
    case Partition::kmeans:
      return shared::kCutKmeans;
    default:
      return shared::kCutLog;
  }
}

Specialization splitsConstants(const Stages& stages) {
  return {cutOf(stages.partition), stages.volume == Volume::samples, stages.focus == Focus::snapped};
}

std::uint32_t sizesOf(const Method& method) {
  if (method.stages->resolution != Resolution::estimated) return shared::kSizesFixed;
  return method.settings.percentile > 0 ? shared::kSizesPercentile : shared::kSizesSmallest;
}

Specialization segmentsConstants(const Method& method) {
  const Stages& stages = *method.stages;
  const std::uint32_t sizes = sizesOf(method);
  if (stages.partition == Partition::tiles) return {shared::kSegmentTile, sizes};
  if (stages.partition == Partition::single) return {shared::kSegmentAll, sizes};
  if (stages.partition == Partition::cube) return {shared::kSegmentFace, sizes};
  return {stages.focus == Focus::snapped ? shared::kSegmentRadius : shared::kSegmentDepth, sizes};
}

std::string_view planShader(Partition partition) {
  if (partition == Partition::tiles) return "plan_tiles.comp";
  if (partition == Partition::cube) return "plan_cube.comp";
  return partition == Partition::single ? "plan_single.comp" : "plan_splits.comp";
}

Specialization planConstants(const Method& method) {
  const Stages& stages = *method.stages;
  const std::uint32_t sizes = sizesOf(method);
  if (stages.partition == Partition::tiles)
    return {stages.focus == Focus::loose   ? shared::kTileCasters
            : stages.focus == Focus::depth ? shared::kTileDepth
                                           : shared::kTileBox,
            stages.resolution == Resolution::ranked, sizes};
  if (!cutsDepth(stages.partition))
    return {stages.focus == Focus::calipers    ? shared::kOnlyHosts
            : stages.volume == Volume::samples ? shared::kOnlySamples
                                               : shared::kOnlyScene,
            0, sizes};
  return {stages.focus == Focus::loose     ? shared::kFitLoose
          : stages.focus == Focus::snapped ? shared::kFitSnapped
                                           : shared::kFitSamples,
          0, sizes};
}

std::string_view lookupShader(const Method& method) {
  switch (method.stages->lookup) {
    case Lookup::hard:
      return "lookup_hard.frag";
    case Lookup::pcf:
      return "lookup_pcf.frag";
    case Lookup::exact3x3:
      return "lookup_exact_3x3.frag";
    case Lookup::rgsm:
      return "lookup_rgsm.frag";
    case Lookup::spsm:
      return walksSurfaces(method) ? "lookup_spsm_walk.frag" : "lookup_spsm.frag";
    case Lookup::evsm:
      return "lookup_evsm.frag";
  }
  return {};
}

std::uint32_t warpOf(Warp warp) {
  return warp == Warp::none          ? shared::kWarpNone
         : warp == Warp::rectilinear ? shared::kWarpRectilinear
                                     : shared::kWarpNonOrthogonal;
}

// Of shaders that have nothing but the warp and its maps to choose, and one number of their own.
Specialization warpConstants(const Stages& stages, std::uint32_t own = 0) {
  return {own, 0, 0, 0, 0, 0, 0, warpOf(stages.warp), stages.partition == Partition::cube};
}

std::uint32_t storeOf(const Method& method) {
  if (!isLinear(method)) return shared::kStoreImage;
  if (method.stages->storage == Storage::triangle) return shared::kStoreTriangles;
  return method.stages->storage == Storage::depthId ? shared::kStoreIds : shared::kStoreDepths;
}

Specialization lookupConstants(const Method& method) {
  const Stages& stages = *method.stages;
  const std::uint32_t choice = [&] {
    if (stages.partition == Partition::tiles) return shared::kChooseTile;
    if (stages.partition == Partition::single) return shared::kChooseOnly;
    if (stages.partition == Partition::cube) return shared::kChooseFace;
    if (method.settings.choose == Choose::tightest) return shared::kChooseTightest;
    return stages.focus == Focus::snapped ? shared::kChooseRadius : shared::kChooseDepth;
  }();
  return {storeOf(method),
          choice,
          shadowViewsOf(method),
          method.settings.blend > 0,
          0,
          0,
          0,
          warpOf(stages.warp),
          stages.partition == Partition::cube};
}

std::uint32_t recoveryOf(Recovery recovery) {
  switch (recovery) {
    case Recovery::off:
      return shared::kRecoverNothing;
    case Recovery::edges:
      return shared::kRecoverEdges;
    case Recovery::walk:
      return shared::kRecoverWalk;
  }
  return 0;
}

// Of the resolve pass, whose lookups may have choices of their own.
Specialization resolveConstants(const Method& method, bool holes, std::uint32_t answer) {
  Specialization constants = lookupConstants(method);
  if (method.stages->lookup == Lookup::spsm) {
    constants[4] = answer;
    constants[5] = recoveryOf(method.settings.recovery);
    constants[6] = method.settings.positions;
    constants.push_back(holes && walksSurfaces(method));
  }
  return constants;
}

}  // namespace

FramePipelines::FramePipelines(const Device& device)
    : layout(device),
      gbuffer(makeGraphicsPipeline(device, layout, gbufferOf("gbuffer.vert", "gbuffer.frag", false))),
      gbufferMasked(makeGraphicsPipeline(device, layout,
                                         gbufferOf("gbuffer_masked.vert", "gbuffer_masked.frag", true))),
      samples(makeGraphicsPipeline(
          device, layout,
          fullscreenOf("samples.frag", {VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32B32A32_UINT}))),
      cullTest(makeComputePipeline(device, layout, "cull_test.comp")),
      cullWrite(makeComputePipeline(device, layout, "cull_write.comp")),
      shade(makeGraphicsPipeline(device, layout,
                                 fullscreenOf("shade.frag", {VK_FORMAT_R8G8B8A8_UNORM}, {VK_FALSE}))),
      shadePlain(makeGraphicsPipeline(device, layout,
                                      fullscreenOf("shade.frag", {VK_FORMAT_R8G8B8A8_UNORM}, {VK_TRUE}))),
      tables(device, uploaded(device, lookupTables(), VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT),
             VK_FORMAT_R32G32_UINT, 8),
      device_(device),
      storeDepth_(makeGraphicsPipeline(device, layout, storeOf("store_depth.vert", "", false))),
      storeDepthMasked_(makeGraphicsPipeline(
          device, layout, storeOf("store_depth_masked.vert", "store_depth_masked.frag", true))) {}

MethodPipelines FramePipelines::of(const Method& method, bool holes) {
  const Stages& stages = *method.stages;
  const bool histogram = stages.partition == Partition::adaptive || stages.partition == Partition::kmeans;
  const bool twoRounds = stages.lookup == Lookup::spsm;
  const auto round = [&](std::string_view shader) {
    GraphicsPipelineInfo info = fullscreenOf(shader, {VK_FORMAT_R32_SFLOAT});
    info.depth = true;
    return drawing(info, resolveConstants(method, holes, shared::kAnswerVisibility));
  };
  MethodPipelines made{
      .plan = compute(planShader(stages.partition), planConstants(method)),
      .store = storeDepth_,
      .storeMasked = storeDepthMasked_,
      .resolve = twoRounds ? round(lookupShader(method))
                           : fullscreen(lookupShader(method), VK_FORMAT_R32_SFLOAT,
                                        resolveConstants(method, holes, shared::kAnswerVisibility)),
      .answers = fullscreen("answers.frag", VK_FORMAT_R32G32B32A32_UINT, lookupConstants(method))};
  // A pipeline that isn't used would still be compiled: a cold start is short of that time.
  const bool samples = asksSamples(stages);
  if (cutsDepth(stages.partition)) {
    made.analyzeSplits = compute("analyze_splits.comp", splitsConstants(stages));
    if (stages.volume == Volume::samples)
      made.analyzeDepths = compute("analyze_depths.comp", {histogram, stages.focus == Focus::snapped});
  }
  if (asksNearness(method)) made.analyzeDepths = compute("analyze_depths.comp", {false, false});
  if (samples) made.analyzeSegments = compute("analyze_segments.comp", segmentsConstants(method));
  if (sizesOf(method) == shared::kSizesPercentile)
    made.analyzeSizes = compute("analyze_sizes.comp", segmentsConstants(method));
  if (stages.partition == Partition::tiles) {
    if (!method.settings.extent) made.analyzeSquare = compute("analyze_square.comp", {});
    if (stages.focus == Focus::loose) made.analyzeCasters = compute("analyze_casters.comp", {});
  }
  if (twoRounds) made.resolveFirst = round("lookup_spsm_first.frag");
  if (stages.resolution == Resolution::estimated && stages.storage == Storage::depth) {
    made.store = drawing(storeOf("store_placed.vert", "", false));
    made.storeMasked = drawing(storeOf("store_placed_masked.vert", "store_depth_masked.frag", true));
    made.storeClear = drawing(clearOf());
  } else if (stages.warp != Warp::none && !isLinear(method)) {
    const Specialization warp = warpConstants(stages);
    made.store = drawing(storeOf("store_warped.vert", "", false), warp);
    made.storeMasked = drawing(storeOf("store_warped_masked.vert", "store_depth_masked.frag", true), warp);
  } else if (stages.storage == Storage::moments) {
    constexpr VkFormat kMoments = VK_FORMAT_R32G32B32A32_SFLOAT;
    made.store = drawing(multisampledOf("store_depth.vert", "", false));
    made.storeMasked = drawing(multisampledOf("store_depth_masked.vert", "store_depth_masked.frag", true));
    made.moments = fullscreen("store_moments.frag", kMoments, {});
    made.blurAcross = fullscreen("blur_across.frag", kMoments, {});
    made.blurDown = fullscreen("blur_down.frag", kMoments, {});
  }
  return made;
}

RasterPipelines FramePipelines::raster(const RasterChoice& choice, bool opaque, bool masked) {
  RasterPipelines made{.begin = compute("raster_begin.comp", {})};
  for (const bool isMasked : {false, true}) {
    if (!(isMasked ? masked : opaque)) continue;
    const Specialization constants{choice.coverage,     isMasked,   choice.ids, 0, 0, 0, 0,
                                   warpOf(choice.warp), choice.cube};
    if (choice.warp != Warp::none) {
      made.kinds[isMasked] = {.clusters = compute("raster_warped_clusters.comp", constants),
                              .listed = compute("raster_warped_listed.comp", constants)};
      continue;
    }
    const auto round = [&](std::string_view plain, std::string_view withId, std::string_view sum) {
      return compute(choice.sums ? sum : choice.ids ? withId : plain, constants);
    };
    made.kinds[isMasked] = {
        .clusters = round("raster_clusters.comp", "raster_clusters_id.comp", "raster_clusters_sum.comp"),
        .listed = round("raster_listed.comp", "raster_listed_id.comp", "raster_listed_sum.comp"),
        .bands = round("raster_bands.comp", "raster_bands_id.comp", "raster_bands_sum.comp")};
  }
  return made;
}

VkPipeline FramePipelines::classify(const Method& method, bool holes) {
  return fullscreen(lookupShader(method), VK_FORMAT_R32_SFLOAT,
                    resolveConstants(method, holes, shared::kAnswerOneTriangle));
}

VkPipeline FramePipelines::want(const Method& method) {
  Specialization constants = lookupConstants(method);
  // The first of two rounds reads a sample's own texel alone.
  if (method.stages->lookup != Lookup::spsm) constants[4] = method.settings.kernel / 2;
  return compute("want_triangles.comp", constants);
}

WarpPipelines FramePipelines::warp(const Method& method) {
  const Stages& stages = *method.stages;
  const auto both = [&](std::string_view shader) {
    return std::array{compute(shader, warpConstants(stages, VK_FALSE)),
                      compute(shader, warpConstants(stages, VK_TRUE))};
  };
  WarpPipelines made{.functions = both("warp_functions.comp"),
                     .centres = compute("warp_centres.comp", warpConstants(stages))};
  if (stages.warp == Warp::rectilinear) {
    made.smooth = both("warp_smooth.comp");
    const Analysis analysis = method.settings.analysis;
    Specialization constants = warpConstants(stages, storeOf(method));
    constants[1] = analysis == Analysis::hybrid;
    made.importance =
        compute(analysis == Analysis::forward ? "warp_forward.comp" : "warp_importance.comp", constants);
  } else {
    made.count = both("warp_count.comp");
    made.pool = both("warp_pool.comp");
    made.bounds = compute("warp_bounds.comp", warpConstants(stages));
  }
  return made;
}

VkPipeline FramePipelines::drawing(GraphicsPipelineInfo info, const Specialization& constants) {
  info.specialization = constants;
  const auto [found, added] =
      variants_.try_emplace({fmt::format("{} {}", info.vertexShader, info.fragmentShader), constants});
  if (added) found->second = makeGraphicsPipeline(device_, layout, info);
  return found->second;
}

VkPipeline FramePipelines::volume(std::string_view vertex) {
  GraphicsPipelineInfo info{.vertexShader = vertex,
                            .fragmentShader = "volume_count.frag",
                            .colourFormats = {VK_FORMAT_R32_SFLOAT},
                            .adds = true};
  if (vertex != "volume_side.vert") {
    info.vertexBindings = SceneBuffers::vertexBindings(false);
    info.vertexAttributes = SceneBuffers::vertexAttributes(true, false);
  }
  return drawing(info);
}

VkPipeline FramePipelines::compute(std::string_view shader, const Specialization& constants) {
  const auto [found, added] = variants_.try_emplace({std::string(shader), constants});
  if (added) found->second = makeComputePipeline(device_, layout, shader, constants);
  return found->second;
}

VkPipeline FramePipelines::fullscreen(std::string_view shader, VkFormat format,
                                      const Specialization& constants) {
  const auto [found, added] = variants_.try_emplace({std::string(shader), constants});
  if (added) found->second = makeGraphicsPipeline(device_, layout, fullscreenOf(shader, {format}, constants));
  return found->second;
}

}  // namespace sundial
