// The histogram of the camera's depth: bins of equal ratio from depthNear to depthFar.
#ifndef SUNDIAL_DEPTH_BINS_GLSL
#define SUNDIAL_DEPTH_BINS_GLSL
#include "bindings.glsl"

uint binOf(float depth) {
  const float octaves = log2(frame.settings.depthFar / frame.settings.depthNear);
  const float bin = log2(depth / frame.settings.depthNear) / octaves * float(kDepthBins);
  return uint(clamp(bin, 0, float(kDepthBins - 1)));
}

// Where a bin begins; bin kDepthBins begins where the last one ends.
float depthOfBin(float bin) {
  return frame.settings.depthNear * pow(frame.settings.depthFar / frame.settings.depthNear, bin / float(kDepthBins));
}

#endif
