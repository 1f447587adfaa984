#version 460
#extension GL_GOOGLE_include_directive : require
// warp=rectilinear, backward and hybrid analysis: how important view samples are. Hybrid: those next to a shadow's edge in the
// light's map, too.
#include "analyze.glsl"
#include "importance.glsl"
#include "warp_samples.glsl"

layout(constant_id = 1) const bool kHybrid = false;

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

void main() {
  for (uint i = 0; i < kSamplesPerInvocation; ++i) {
    const uint pixel = firstPixel() + i * kSampleGroup;
    if (pixel >= pixelCount()) break;
    const ViewSample s = sampleOf(pixel);
    uint view;
    vec2 p;
    if (!positionOf(s, view, p)) continue;
    const uvec2 texel = min(uvec2(p), warpSize() - 1);
    vec2 sum = vec2(0);
    if (weightOf(kNearness) > 0) sum += weightOf(kNearness) * nearness(s.wsPosition);
    if (weightOf(kFacing) > 0) sum += weightOf(kFacing) * abs(dot(s.wsNormal, normalize(frame.wsEye - s.wsPosition)));
    if (weightOf(kEdges) > 0 && isEdge(ivec2(pixel % frame.imageSize.x, pixel / frame.imageSize.x)))
      sum += weightOf(kEdges);
    if (weightOf(kDensity) > 0) sum += weightOf(kDensity) * density(view, s.wsPosition, s.wsNormal);
    if (kHybrid && weightOf(kShadowEdges) > 0 && isShadowEdge(view, ivec2(texel))) sum += weightOf(kShadowEdges);
    makeImportant(view, texel, sum);
  }
}
