// What the compute rasteriser's dispatches hand to each other (../raster.glsl).
#ifndef SUNDIAL_SHARED_RASTER_H
#define SUNDIAL_SHARED_RASTER_H
#include "interop.h"
#include "plan.h"
#include "scene.h"

SUNDIAL_SHARED_BEGIN

SUNDIAL_CONST kSubTexels = 256u;  // steps of the grid that vertices lie on, to a texel
// A triangle whose box has at most this many texels a side, which is as far as 32 bits reach, is drawn by one
// invocation if it covers few of them. Others are cut into bands of rows, a workgroup each, an invocation a
// row.
SUNDIAL_CONST kSmallSide = 127u;
SUNDIAL_CONST kSmallTexels = 500u;
SUNDIAL_CONST kBandRows = 32u;
// Within so many texels of a row 32 bits hold what its edges come to.
SUNDIAL_CONST kSegmentTexels = 256u;
// Vertices of a triangle that was clipped at the four sides of a map.
SUNDIAL_CONST kMaxPolygon = 7u;

SUNDIAL_CONST kRasterKinds = 2u;          // opaque and masked triangles, each with its own lists
SUNDIAL_CONST kWorkgroupsInRow = 32768u;  // of a dispatch; further ones go into its next row

// What a texel takes of a triangle.
SUNDIAL_CONST kCoverCentre = 0u;  // those whose centre lies in it, with its depth there
// All that touch it, with the nearest depth of its plane in the texel; with ids, of those that are as near to
// within a texel's width, the one that covers most of the texel (raster_fill.glsl).
SUNDIAL_CONST kCoverConservative = 1u;

SUNDIAL_CONST kSumFactor = 2654435761u;  // keep_sum.glsl

struct DispatchCommand {  // VkDispatchIndirectCommand
  uint x;
  uint y;
  uint z;
};

// A triangle of a draw in a view.
struct ListedTriangle {
  uint view;
  uint id;  // triangleId()
};

// A large triangle on a map's grid, or a part of one that was clipped.
struct RasterPart {
  uint view;
  uint id;
  int x[3];  // 1/256 texels from the centre of the map's first texel; turning the same way for all
  int y[3];
  int box[4];  // texels, first and last
  vec3 depth;  // Varying
  float depthAtMost;
  vec4 attributes[3];  // of masked triangles: (uv, alpha, 1) over w
};

// kBandRows rows of a part.
struct RasterBand {
  uint part;
  uint band;  // counted from the first of its box
};

struct RasterState {
  DispatchCommand clusters[kMaxShadowViews * kBuckets];
  DispatchCommand listed[kRasterKinds];
  DispatchCommand bands[kRasterKinds];
  // How many there were of each: more than there is room for means that some were lost.
  uint listedCount[kRasterKinds];
  uint partCount[kRasterKinds];
  uint bandCount[kRasterKinds];
  uint triangles;  // looked at, for the record
};

// Push constants of all of its dispatches.
struct RasterPush {
  uint view;
  uint bucket;
  uint listedRoom;  // of each kind
  uint partRoom;
  uint bandRoom;
};

SUNDIAL_SHARED_END
#endif
