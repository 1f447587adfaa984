#version 460
#extension GL_GOOGLE_include_directive : require
// How large the square of volume=inscribed must be to hold every view sample, where it stands about the camera as it does
// [Alecu 2014, section 3.3]. The paper is given its size.
#include "analyze.glsl"

void main() {
  float side = 0;
  for (uint i = 0; i < kSamplesPerInvocation; ++i) {
    const uint pixel = firstPixel() + i * kSampleGroup;
    if (pixel >= pixelCount()) break;
    const ViewSample s = sampleOf(pixel);
    if (!facesLight(s)) continue;
    const vec4 light = frame.lightFromWorld * vec4(s.wsPosition, 1);
    if (light.w <= 0) continue;
    const vec2 offset = light.xy / light.w - frame.settings.lsSquareEye;
    const vec2 sides = max(offset / max(frame.settings.squareBefore, 1e-6), -offset / max(frame.settings.squareBehind, 1e-6));
    side = max(side, max(sides.x, sides.y));
  }
  side = subgroupMax(side);
  if (subgroupElect()) atomicMax(analysis.lsSquareSide, floatBitsToUint(side));
}
