// The numbers by which specialization constants select what a stage's shader does: set by
// frame_pipelines.cpp, read by the shader that each list names.
#ifndef SUNDIAL_SHARED_CHOICES_H
#define SUNDIAL_SHARED_CHOICES_H
#include "interop.h"

SUNDIAL_SHARED_BEGIN

// Where the camera's depth is cut: analyze_splits.comp.
SUNDIAL_CONST kCutManual = 0u, kCutUniform = 1u, kCutLog = 2u, kCutPractical = 3u, kCutAdaptive = 4u,
              kCutKmeans = 5u;

// Which part of the plan a view sample belongs to: segments.glsl.
SUNDIAL_CONST kSegmentAll = 0u, kSegmentDepth = 1u, kSegmentRadius = 2u, kSegmentTile = 3u, kSegmentFace = 4u;

// What the only view's or a face's box is: the scene's, the samples', or what the host found:
// plan_single.comp, plan_cube.comp.
SUNDIAL_CONST kOnlyScene = 0u, kOnlySamples = 1u, kOnlyHosts = 2u;

// What a partition's box is fitted to: plan_splits.comp.
SUNDIAL_CONST kFitLoose = 0u, kFitSamples = 1u, kFitSnapped = 2u;

// What a tile is fitted to, casters' bounds in depth, samples in depth, or samples on all sides:
// plan_tiles.comp.
SUNDIAL_CONST kTileCasters = 0u, kTileDepth = 1u, kTileBox = 2u;

// How large maps are: as the method says, or from the smallest or a percentile of the pixels' sizes:
// analyze_segments.comp, estimate.glsl.
SUNDIAL_CONST kSizesFixed = 0u, kSizesSmallest = 1u, kSizesPercentile = 2u;

// How a map is re-parameterised: warp.glsl.
SUNDIAL_CONST kWarpNone = 0u, kWarpRectilinear = 1u, kWarpNonOrthogonal = 2u;

// Which view answers a sample: choose_view.glsl.
SUNDIAL_CONST kChooseOnly = 0u, kChooseDepth = 1u, kChooseRadius = 2u, kChooseTightest = 3u, kChooseTile = 4u,
              kChooseFace = 5u;

// Where maps lie: in an image, or in a linear buffer of depths, or of depths with the triangles that have
// them: stored_depth.glsl.
SUNDIAL_CONST kStoreImage = 0u, kStoreDepths = 1u, kStoreIds = 2u, kStoreTriangles = 3u;

// What lookup_spsm.frag gives out: how lit a sample is, or what that was found from: the triangle of its own
// texel, those of its neighbours too, or the rebuilt edge.
SUNDIAL_CONST kAnswerVisibility = 0u, kAnswerOneTriangle = 1u, kAnswerNeighbours = 2u, kAnswerUncertain = 3u;

// What becomes of samples that no stored triangle decides: texel_triangle.glsl, lookup_spsm.frag.
SUNDIAL_CONST kRecoverNothing = 0u, kRecoverEdges = 1u, kRecoverWalk = 2u;

SUNDIAL_SHARED_END
#endif
