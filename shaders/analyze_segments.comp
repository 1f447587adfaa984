#version 460
#extension GL_GOOGLE_include_directive : require
// The boxes of the view samples in light space, one a segment [Lauritzen et al. 2011, section 3.3], how many samples each
// has, how important they are [Alecu 2014, section 3.3], and how small their smallest pixel [Ferko 2013, section 3.2]. A thread's
// pixels mostly lie in one segment: it hands over what it has when the segment changes.
#include "analyze.glsl"
#include "sample_segment.glsl"

layout(constant_id = 1) const uint kSizes = kSizesFixed;

struct Found {
  vec3 low;
  vec3 high;
  uint samples;
  uint importance;
  vec2 pixel;  // the smallest width and height
};
const Found kNothing = Found(vec3(1e38), vec3(-1e38), 0, 0, vec2(1e38));

void handOver(uint segment, Found found) {
  for (uint axis = 0; axis < 3; ++axis) {
    atomicMin(analysis.lsMin[3 * segment + axis], orderedFromFloat(found.low[axis]));
    atomicMax(analysis.lsMax[3 * segment + axis], orderedFromFloat(found.high[axis]));
  }
  atomicAdd(analysis.sampleCount[segment], found.samples);
  for (uint axis = 0; kSizes == kSizesSmallest && axis < 2; ++axis)
    atomicMin(analysis.lsPixelMin[2 * segment + axis], orderedFromFloat(found.pixel[axis]));
  if (kSegments == kSegmentTile) atomicAdd(analysis.importance[segment], found.importance);
}

// [Alecu 2014, equation 3.1], in integers.
uint importanceOf(float depth) {
  const float given = frame.settings.importanceRange, range = given > 0 ? given : 0.25 * inscribedSquare().side;
  const float nearness = clamp(1 - depth / range, 0, 1);
  return uint((1 + frame.settings.importanceGain * nearness) * frame.settings.importanceUnit + 0.5);
}

// Whether the sample lies in the last part of its partition's depth, which fades into the next.
bool fades(ViewSample s, uint segment) {
  if (kSegments != kSegmentDepth && kSegments != kSegmentRadius) return false;
  if (frame.settings.blend == 0 || segment + 1 >= frame.settings.partitions) return false;
  const float begin = analysis.splits[segment], end = analysis.splits[segment + 1];
  return viewDepth(s.wsPosition, kSegments == kSegmentRadius) > end - frame.settings.blend * (end - begin);
}

void main() {
  uint current = 0;
  Found found = kNothing;
  LightRays rays = raysOf(0);
  for (uint i = 0; i < kSamplesPerInvocation; ++i) {
    const uint pixel = firstPixel() + i * kSampleGroup;
    if (pixel >= pixelCount()) break;
    const ViewSample s = sampleOf(pixel);
    if (!facesLight(s)) continue;
    vec4 light = frame.lightFromWorld * vec4(s.wsPosition, 1);
    uint segment;
    if (!segmentOf(s, light, segment)) continue;
    if (kSegments == kSegmentFace) light = faceFromLight(segment, light);
    const vec3 ls = light.xyz / light.w;
    if (segment != current && found.samples > 0) {
      handOver(current, found);
      found = kNothing;
    }
    current = segment;
    found.low = min(found.low, ls);
    found.high = max(found.high, ls);
    ++found.samples;
    // A sample that fades into the next partition must find itself there too.
    if (fades(s, segment)) handOver(segment + 1, Found(ls, ls, 0, 0, vec2(1e38)));
    if (kSizes == kSizesSmallest) {
      if (kSegments == kSegmentFace) rays = raysOf(segment);
      found.pixel = min(found.pixel, pixelSize(ivec2(pixel % frame.imageSize.x, pixel / frame.imageSize.x), rays));
    }
    if (kSegments == kSegmentTile) found.importance += importanceOf(viewDepth(s.wsPosition, false));
  }
  if (subgroupAllEqual(current)) {
    found = Found(subgroupMin(found.low), subgroupMax(found.high), subgroupAdd(found.samples),
                  subgroupAdd(found.importance), subgroupMin(found.pixel));
    if (subgroupElect() && found.samples > 0) handOver(current, found);
  } else if (found.samples > 0) {
    handOver(current, found);
  }
}
