#version 460
#extension GL_GOOGLE_include_directive : require
// As store_tessellated.tese, with what the alpha test needs.
#include "store_warped.glsl"

layout(triangles, equal_spacing) in;

layout(location = 0) in vec2 uv[];
layout(location = 1) in float alpha[];
layout(location = 2) in uint material[];
layout(location = 0) out vec2 outUv;
layout(location = 1) out float outAlpha;
layout(location = 2) flat out uint outMaterial;

void main() {
  vec4 shadow = vec4(0);
  outUv = vec2(0);
  outAlpha = 0;
  outMaterial = material[0];
  for (int i = 0; i < 3; ++i) {
    shadow += gl_TessCoord[i] * gl_in[i].gl_Position;
    outUv += gl_TessCoord[i] * uv[i];
    outAlpha += gl_TessCoord[i] * alpha[i];
  }
  gl_Position = warpedClip(0, shadow);
}
