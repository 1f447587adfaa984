// resolution=estimated: how many texels a box needs so that none is larger than the pixels that ask it [Ferko 2013,
// section 3.2], width and height apart.
#ifndef SUNDIAL_ESTIMATE_GLSL
#define SUNDIAL_ESTIMATE_GLSL
#include "plan_view.glsl"
#include "shared/choices.h"
#include "size_bins.glsl"

layout(constant_id = 2) const uint kSizes = kSizesFixed;

const uint kLeastTexels = 16;

// The size that `smallerShare` of the segment's pixels stay below; between a bin's ends, as if they were spread evenly.
float percentileOf(uint segment, uint axis) {
  const uint first = (2 * segment + axis) * kSizeBins;
  uint counted = 0;
  for (uint bin = 0; bin < kSizeBins; ++bin) counted += analysis.pixelHistogram[first + bin];
  const float wanted = frame.settings.smallerShare * float(counted);
  float before = 0;
  for (uint bin = 0; bin < kSizeBins; ++bin) {
    const float here = float(analysis.pixelHistogram[first + bin]);
    if (here > 0 && before + here >= wanted) return sizeOfBin(float(bin) + (wanted - before) / here);
    before += here;
  }
  return sizeOfBin(float(kSizeBins));
}

// Of a texel, light space after division; for a segment with samples.
vec2 wantedTexel(uint segment) {
  if (kSizes == kSizesPercentile) return vec2(percentileOf(segment, 0), percentileOf(segment, 1));
  return vec2(floatFromOrdered(analysis.lsPixelMin[2 * segment]), floatFromOrdered(analysis.lsPixelMin[2 * segment + 1]));
}

// Of a map around this box, a part of `all` of the scene, and so many more at its rims; at most the common size.
uvec2 texelsFor(uint segment, LightBox box, LightBox all, float rims) {
  if (kSizes == kSizesFixed) return frame.settings.mapSize;
  if (analysis.sampleCount[segment] == 0) return min(uvec2(kLeastTexels), frame.settings.mapSize);
  const vec2 most = vec2(frame.settings.mapSize);
  const vec2 finest = frame.settings.finestTexel * (all.high.xy - all.low.xy) / max(most - rims, vec2(1));
  const vec2 wanted = (box.high.xy - box.low.xy) / max(max(wantedTexel(segment), finest), vec2(1e-30)) + rims;
  // Rounding mustn't cost a whole texel.
  return uvec2(clamp(ceil(wanted - 1e-3), min(vec2(kLeastTexels), most), most));
}

shared uvec2 mapTexels[kMaxShadowViews];

// Where a view's map lies when maps stand shelf by shelf in the store's image, or behind each other in its buffer. After
// all views have said how large theirs are.
void shelve(uint view) {
  if (kSizes == kSizesFixed) return;
  const uint columns = frame.settings.mapColumns, shelf = view / columns;
  uvec2 offset = uvec2(0);
  uint height = 0, before = 0;
  for (uint other = 0; other < view; ++other) {
    before += mapTexels[other].x * mapTexels[other].y;
    if (other / columns == shelf) {
      offset.x += mapTexels[other].x;
    } else {
      height = max(height, mapTexels[other].y);
      if (other % columns == columns - 1) {
        offset.y += height;
        height = 0;
      }
    }
  }
  const bool linear = frame.storeSize.y == 1;
  plan.views[view].rectOffset = linear ? uvec2(0) : offset;
  plan.views[view].linearOffset = linear ? before : 0;
}

#endif
