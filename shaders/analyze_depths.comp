#version 460
#extension GL_GOOGLE_include_directive : require
// The range of the camera's depth that view samples lie in, and how they lie in it [Lauritzen et al. 2011, section 3.1].
// Departure: only those that face the light count, the others need no shadow.
#include "analyze.glsl"
#include "depth_bins.glsl"

layout(constant_id = 0) const bool kHistogram = false;
layout(constant_id = 1) const bool kRadial = false;

void main() {
  float low = 1e38, high = -1e38;
  for (uint i = 0; i < kSamplesPerInvocation; ++i) {
    const uint pixel = firstPixel() + i * kSampleGroup;
    if (pixel >= pixelCount()) break;
    const ViewSample s = sampleOf(pixel);
    if (!facesLight(s)) continue;
    const float depth = viewDepth(s.wsPosition, kRadial);
    low = min(low, depth);
    high = max(high, depth);
    if (kHistogram) atomicAdd(analysis.depthHistogram[binOf(depth)], 1);
  }
  low = subgroupMin(low);
  high = subgroupMax(high);
  if (!subgroupElect() || low > high) return;
  atomicMin(analysis.depthMin, orderedFromFloat(low));
  atomicMax(analysis.depthMax, orderedFromFloat(high));
}
