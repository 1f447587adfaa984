// The lists of the compute rasteriser's rounds.
#ifndef SUNDIAL_RASTER_STATE_GLSL
#define SUNDIAL_RASTER_STATE_GLSL
#include "bindings.glsl"
#include "shared/raster.h"

layout(push_constant, scalar) uniform Push { RasterPush push; };
layout(set = 0, binding = kBindRaster, scalar) buffer RasterBlock { RasterState raster; };
layout(set = 0, binding = kBindListed, scalar) buffer ListedBlock { ListedTriangle listed[]; };
layout(set = 0, binding = kBindParts, scalar) buffer PartBlock { RasterPart parts[]; };
layout(set = 0, binding = kBindBands, scalar) buffer BandBlock { RasterBand bands[]; };

#endif
