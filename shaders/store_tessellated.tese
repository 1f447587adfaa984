#version 460
#extension GL_GOOGLE_include_directive : require
// A piece's corner, warped.
#include "store_warped.glsl"

layout(triangles, equal_spacing) in;

void main() {
  vec4 shadow = vec4(0);
  for (int i = 0; i < 3; ++i) shadow += gl_TessCoord[i] * gl_in[i].gl_Position;
  gl_Position = warpedClip(0, shadow);
}
