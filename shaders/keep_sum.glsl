// A texel sums a number of each triangle that covers it, as often as it is covered: what tests compare, because one
// triangle too few or too many anywhere gives another sum.
#ifndef SUNDIAL_KEEP_GLSL
#define SUNDIAL_KEEP_GLSL
#include "bindings.glsl"
#include "shared/raster.h"

void keep(uint index, float depth, uint id) { atomicAdd(linearStore[index], (id + 1) * kSumFactor); }

#endif
