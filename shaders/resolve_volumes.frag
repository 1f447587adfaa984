#version 460
#extension GL_GOOGLE_include_directive : require
// A sample is lit where it is in no volume.
#include "light.glsl"

layout(location = 0) out float outVisibility;

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  outVisibility = facesLight(sampleAt(pixel)) && texelFetch(store, pixel, 0).r < 0.5 ? 1.0 : 0.0;
}
