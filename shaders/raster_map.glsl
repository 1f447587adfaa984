// Where a map's texels lie: on the grid of the view itself, or of a warp of it.
//
// A warp is told by its inverse. Triangles stay straight: they are placed in the view as it is without the warp, each
// texel's centre is carried back there, and whether it is covered is decided there. A warp brings three functions, and
// its choice of kTexelMap:
//   linearSize   texels of the view without the warp, over which the grid of 1/256 texel is laid: more than the map has
//                where the warp magnifies, at most 16384 a side
//   linearOf     where a texel's centre lies on that grid, counted from the centre of its first texel
//   warpedBox    texels (first and last, both included) among which are all whose centre lies in a box of that grid
#ifndef SUNDIAL_RASTER_MAP_GLSL
#define SUNDIAL_RASTER_MAP_GLSL
#include "bindings.glsl"
#include "shared/raster.h"

layout(constant_id = 2) const uint kTexelMap = kMapLinear;

bool isWarped() { return kTexelMap != kMapLinear; }

uvec2 linearSize(uint view) { return plan.views[view].rectSize; }

ivec2 linearOf(uint view, ivec2 texel) { return texel * int(kSubTexels); }

ivec4 warpedBox(uint view, ivec4 grid) { return ivec4((grid.xy + int(kSubTexels) - 1) >> 8, grid.zw >> 8); }

#endif
