#version 460
#extension GL_GOOGLE_include_directive : require
// warp=non-orthogonal: how many view samples fall into each texel [NOTW, section 3]; the second time after the rows' warp.
#include "analyze.glsl"
#include "warp_samples.glsl"

layout(constant_id = 0) const bool kDown = false;

void main() {
  for (uint i = 0; i < kSamplesPerInvocation; ++i) {
    const uint pixel = firstPixel() + i * kSampleGroup;
    if (pixel >= pixelCount()) break;
    uint view;
    vec2 p;
    if (!positionOf(sampleOf(pixel), view, p)) continue;
    if (kDown) p.x = warpedAcross(view, p);
    const uvec2 texel = min(uvec2(p), warpSize() - 1);
    atomicAdd(importance[importanceAt(view) + texel.y * warpSize().x + texel.x], 1);
  }
}
