#version 460
#extension GL_GOOGLE_include_directive : require
// How large pixels are in light space, for a percentile of their sizes: counted in bins by integer atomics, whose sums depend
// on no order. A quarter of the pixels says as much as all: of every four runs of eight one, the next one in the next row.
#include "analyze.glsl"
#include "sample_segment.glsl"
#include "size_bins.glsl"

const uint kRun = 8;  // as wide as a subgroup of the processor's

uint measuredPixel(uint index) {
  const uint block = index / kRun * kPixelsPerMeasured, row = block * kRun / frame.imageSize.x;
  return (block + row % kPixelsPerMeasured) * kRun + index % kRun;
}

void main() {
  LightRays rays = raysOf(0);
  for (uint i = 0; i < kSamplesPerInvocation; ++i) {
    const uint pixel = measuredPixel(firstPixel() + i * kSampleGroup);
    if (pixel >= pixelCount()) break;
    const ViewSample s = sampleOf(pixel);
    uint segment;
    if (!facesLight(s) || !segmentOf(s, frame.lightFromWorld * vec4(s.wsPosition, 1), segment)) continue;
    if (kSegments == kSegmentFace) rays = raysOf(segment);
    const vec2 size = pixelSize(ivec2(pixel % frame.imageSize.x, pixel / frame.imageSize.x), rays);
    for (uint axis = 0; axis < 2; ++axis)
      atomicAdd(analysis.pixelHistogram[(2 * segment + axis) * kSizeBins + binOfSize(size[axis])], 1);
  }
}
