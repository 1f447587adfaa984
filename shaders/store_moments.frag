#version 460
#extension GL_GOOGLE_include_directive : require
// storage=moments: what four depths of a texel come to [Lauritzen et al. 2011, section 4].
#include "moments.glsl"

layout(push_constant) uniform Push { uint view; };
layout(location = 0) out vec4 outMoments;

void main() {
  const int kSamples = 4;
  vec2 mean = vec2(0), meanSquare = vec2(0);
  for (int i = 0; i < kSamples; ++i) {
    const vec2 w = warped(view, texelFetch(multisampled, ivec2(gl_FragCoord.xy), i).r);
    mean += w / kSamples;
    meanSquare += w * w / kSamples;
  }
  outMoments = vec4(mean.x, meanSquare.x, mean.y, meanSquare.y);
}
