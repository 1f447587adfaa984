// The bins of Analysis::pixelHistogram: sizes by their logarithm.
#ifndef SUNDIAL_SIZE_BINS_GLSL
#define SUNDIAL_SIZE_BINS_GLSL
#include "shared/plan.h"

uint binOfSize(float size) {
  const float bin = (log2(size) + float(kSizeOctavesBelow)) * float(kSizeBinsPerOctave);
  return uint(clamp(bin, 0, float(kSizeBins - 1)));
}

float sizeOfBin(float bin) { return exp2(bin / float(kSizeBinsPerOctave) - float(kSizeOctavesBelow)); }

#endif
