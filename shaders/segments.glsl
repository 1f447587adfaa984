// Which part of the plan a view sample belongs to: its partition along the camera's depth, or its tile.
#ifndef SUNDIAL_SEGMENTS_GLSL
#define SUNDIAL_SEGMENTS_GLSL
#include "shared/choices.h"
#include "view_depth.glsl"

// The last partition takes what lies behind all others, the first what lies before them.
uint partitionOf(float depth) {
  uint part = 0;
  for (uint i = 1; i < frame.settings.partitions; ++i) part += depth >= analysis.splits[i] ? 1 : 0;
  return part;
}

#endif
