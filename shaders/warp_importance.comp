#version 460
#extension GL_GOOGLE_include_directive : require
// warp=rectilinear, backward analysis [Rosen 2012, as NOTW section 2.2 describes it]: how important view samples are, and the
// most of each column and row. Floats of at least 0 are ordered as their bits are.
#include "analyze.glsl"
#include "warp_samples.glsl"

// A step of depth, as a share of it, to a neighbour on another surface; on a plane the reciprocal of depth has none.
bool isEdge(ivec2 pixel) {
  const ivec2 last = ivec2(frame.imageSize) - 1;
  const float here = texelFetch(gbufferDepth, pixel, 0).r;
  float bend = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const ivec2 step_ = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
    const float before = texelFetch(gbufferDepth, max(pixel - step_, ivec2(0)), 0).r;
    const float after = texelFetch(gbufferDepth, min(pixel + step_, last), 0).r;
    bend = max(bend, abs(before + after - 2 * here));
  }
  return bend > 0.02 * here;
}

float importanceOf(ViewSample s, ivec2 pixel) {
  const vec3 weights = frame.settings.warpWeights;
  const float depth = max(viewDepth(s.wsPosition, false), frame.nearDistance);
  float sum = weights.x * min(floatFromOrdered(analysis.depthMin) / depth, 1);
  if (weights.y > 0) sum += weights.y * abs(dot(s.wsNormal, normalize(frame.wsEye - s.wsPosition)));
  if (weights.z > 0 && isEdge(pixel)) sum += weights.z;
  return sum;
}

void raise(uint at, uint value) {
  if (importance[at] < value) atomicMax(importance[at], value);
}

void main() {
  for (uint i = 0; i < kPixelsPerThread; ++i) {
    const uint pixel = firstPixel() + i * 64;
    if (pixel >= pixelCount()) break;
    const ViewSample s = sampleOf(pixel);
    vec2 p;
    if (!positionOf(s, p)) continue;
    const uvec2 texel = min(uvec2(p), warpSize() - 1);
    const uint value = floatBitsToUint(importanceOf(s, ivec2(pixel % frame.imageSize.x, pixel / frame.imageSize.x)));
    raise(texel.x, value);
    raise(warpSize().x + texel.y, value);
  }
}
