// The plan: what the stages before storage produce, written on the GPU, read by cull, store and resolve, and
// streamed to clients as the tile layout. And what it is made from: the method's settings and the analysis.
#ifndef SUNDIAL_SHARED_PLAN_H
#define SUNDIAL_SHARED_PLAN_H
#include "cube.h"
#include "interop.h"

SUNDIAL_SHARED_BEGIN

SUNDIAL_CONST kMaxShadowViews = 64u;
SUNDIAL_CONST kMaxPartitions = 8u;  // along the camera's depth
SUNDIAL_CONST kNoShadowView = 0xffffffffu;

// What makes a place important to a rectilinear warp: nearness to the eye, facing it, an edge in the camera's
// depth or in the light's, and how many texels a pixel asks for: ../importance.glsl.
SUNDIAL_CONST kNearness = 0u, kFacing = 1u, kEdges = 2u, kShadowEdges = 3u, kDensity = 4u;
SUNDIAL_CONST kImportanceFunctions = 5u;

// One map of the store. Shadow space after the division by w: x and y in [-1, 1] across the rectangle, y down
// as in the image, depth reversed: 1 at the near plane, 0 at the far plane.
struct ShadowView {
  mat4 shadowFromWorld;  // from world space relative to the frame's origin (FrameConstants)
  vec3 lsMin;            // the same box in light space after division: what lookups read, it is less
  vec3 lsMax;
  uvec2 rectOffset;  // texels, in the store's image
  uvec2 rectSize;    // texels
  vec2 texelSize;    // directional: metres; spot, point: metres at one metre along the map's axis
  float
      nearDistance;  // along the light, metres: directional from the light-space origin, else from the light
  float farDistance;
  uint sampleCount;   // view samples that chose this view; 0 where the partition doesn't count
  uint importance;    // summed, in units of PlanSettings::importanceUnit; 0 where nothing ranks by it
  uint empty;         // 1: nothing to draw
  uint linearOffset;  // texels, in the store's buffer (storage=linear)
  float depthBegin;   // the range of the camera's depth that it was made for, metres; 0 and 0 where there is
                      // none
  float depthEnd;
  uint tile;  // y * tilesPerSide + x (partition=tiles)
  uint padding;
};

struct Plan {
  mat4 lightFromWorld;  // the axes of light space that all views share
  mat4 worldFromLight;  // its inverse: carries planes from world to light space
  uint viewCount;
  uint tilesPerSide;  // 0: no tiles
  vec2 lsSquareMin;   // tiles: the corner of the first, in light space after division
  float lsTileSide;   // metres; spot: at one metre from the light
  uint padding0;
  uint padding1;
  uint padding2;
  uint viewOfTile[kMaxShadowViews];
  ShadowView views[kMaxShadowViews];
};

// What the method's parameters and the host say to the stages before storage.
struct PlanSettings {
  uvec2 mapSize;    // texels of each map
  uint drawsAll;    // 1: views aren't culled
  uint mapColumns;  // maps in a row of the store's image
  uint partitions;
  float depthNear;  // camera depths that splits are made between (volume=frustum) and that the histogram
                    // spans, metres
  float depthFar;
  float lambda;                  // practical split: 1 is logarithmic, 0 uniform
  float blend;                   // share of a partition's depth in which it fades into the next
  float splits[kMaxPartitions];  // manual: where each partition ends, metres
  // Where the frame's origin lies on the grids of focus=snapped: light space, metres, modulo kSnapPeriod.
  vec2 lsOriginOnGrid;
  uint tilesPerSide;
  float importanceGain;   // m of [Alecu 2014, equation 3.1]
  float importanceRange;  // k, metres; 0: a quarter of the square's side
  float importanceUnit;   // integers a unit of importance
  // volume=inscribed: the square about the camera, in light space after division.
  vec2 lsSquareEye;                  // where the camera stands
  vec2 squareBehind;                 // how far the square reaches from there towards smaller coordinates,
  vec2 squareBefore;                 // and towards greater ones, in shares of its side
  float lsSquareSide;                // 0: the smallest that holds all view samples,
  float lsSquareSideAtMost;          // but no more than this
  uint tileTexels[kMaxShadowViews];  // a side, of view v
  // How far beyond its own samples or part of the scene a view is drawn at least, light space after division:
  // to this depth, and by this much to each side.
  float lsFar;
  float lsReach;
  float rimTexels;  // about a map, where lookups would look beyond it
  // resolution=estimated: the share of samples whose pixels may be smaller than a texel; the smallest texel,
  // over one of a map of the whole scene with as many; and the size of the picture that a view's map is drawn
  // as a part of, texels.
  float smallerShare;
  float finestTexel;
  uvec2 viewport;
  // The warp: over how many texels importance is smoothed, or how many rows share a function; how much of a
  // function is spread evenly; the power of importance that the rest follows; and what counts how much for a
  // rectilinear one, in the order of kNearness to kDensity.
  uint warpWindow;
  uint warpEntries;  // of a view's tables: ../warp.glsl
  float warpEvenShare;
  float warpPower;
  float warpWeights[kImportanceFunctions];
  // focus=calipers: what the host found, light space after division; low above high where there is nothing.
  vec3 lsFitMin;
  vec3 lsFitMax;
};
SUNDIAL_CONST kSnapPeriod = 4096u;  // metres, the coarsest texel of focus=snapped

SUNDIAL_CONST kDepthBins = 512u;
// Sizes of pixels in light space, kSizeBinsPerOctave to a doubling, from 2^-kSizeOctavesBelow.
SUNDIAL_CONST kSizeBins = 512u;
SUNDIAL_CONST kSizeBinsPerOctave = 12u;
SUNDIAL_CONST kSizeOctavesBelow = 26u;

// What the analysis of the view samples found: floats in an order-preserving code, so that integer atomics
// reduce them and the result depends on no order. A segment is a partition, a tile or a cube's face; without
// any there is one.
struct Analysis {
  mat4 lightFromWorld;               // FrameConstants' when this was found: the axes of all bounds
  float splits[kMaxPartitions + 1];  // partition i has camera depths from [i] to [i + 1], metres
  // From here on cleared to ones,
  uint depthMin;  // 0xffffffff: no sample
  uint lsMin[3 * kMaxShadowViews];
  uint lsPixelMin[2 * kMaxShadowViews];  // the smallest pixel's width and height (resolution=estimated)
  // and from here on to zeros.
  uint depthMax;
  uint lsSquareSide;  // bits of a float: what holds all samples (volume=inscribed)
  uint lsMax[3 * kMaxShadowViews];
  uint sampleCount[kMaxShadowViews];
  uint importance[kMaxShadowViews];
  uint depthHistogram[kDepthBins];  // samples, over the logarithm of depth from depthNear to depthFar
  uint pixelHistogram[2 * kMaxShadowViews *
                      kSizeBins];  // samples that are counted, over their pixels' width, then height
};

SUNDIAL_SHARED_END
#endif
