#version 460
#extension GL_GOOGLE_include_directive : require
// As store_tessellated.tesc, with what the alpha test needs.
#include "tessellate.glsl"

layout(vertices = 3) out;

layout(location = 0) in vec2 uv[];
layout(location = 1) in float alpha[];
layout(location = 2) in uint material[];
layout(location = 0) out vec2 outUv[];
layout(location = 1) out float outAlpha[];
layout(location = 2) out uint outMaterial[];

void main() {
  gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
  outUv[gl_InvocationID] = uv[gl_InvocationID];
  outAlpha[gl_InvocationID] = alpha[gl_InvocationID];
  outMaterial[gl_InvocationID] = material[gl_InvocationID];
  if (gl_InvocationID == 0) setLevels(gl_in[0].gl_Position, gl_in[1].gl_Position, gl_in[2].gl_Position);
}
