// Who draws a depth map: the graphics pipeline into an image, or the compute rasteriser into a linear buffer.
#pragma once

#include "gpu/device.h"
#include "shadow/method.h"

namespace sundial {

// The same method with raster=auto decided, for a scene of so many triangles, instances counted. The decision
// depends on nothing else, so that every server of one driver answers with the same bytes; README.md has the
// rule.
Method withRaster(Method, const Device&, std::uint64_t triangles);

// Of maps in a linear buffer.
std::uint64_t linearBytesPerTexel(const Stages&);

// Whether maps lie in a linear buffer. Of a method whose raster isn't auto.
bool isLinear(const Method&);

}  // namespace sundial
