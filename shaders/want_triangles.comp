#version 460
#extension GL_GOOGLE_include_directive : require
// storage=triangle: lists the texels that the lookups of all samples begin with.
#include "choose_view.glsl"
#include "shared/samples.h"
#include "want_around.glsl"

layout(constant_id = 4) const uint kReach = 0;  // texels about a sample's own

layout(local_size_x = kSampleGroup) in;

void main() {
  const uvec2 size = uvec2(textureSize(samplePositions, 0));
  const uint first = gl_WorkGroupID.x * kSampleGroup * kSamplesPerInvocation + gl_LocalInvocationID.x;
  for (uint i = 0; i < kSamplesPerInvocation; ++i) {
    const uint pixel = first + i * kSampleGroup;
    if (pixel >= size.x * size.y) break;
    const ViewSample s = sampleAt(ivec2(pixel % size.x, pixel / size.x));
    if (!facesLight(s)) continue;
    const Choice c = chooseView(s);
    if (c.view == kNoShadowView) continue;
    wantAround(c.view, receiverIn(c.view, s).texel, kReach);
    if (kBlend && c.nextWeight > 0) wantAround(c.next, receiverIn(c.next, s).texel, kReach);
  }
}
