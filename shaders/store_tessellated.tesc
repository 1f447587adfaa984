#version 460
#extension GL_GOOGLE_include_directive : require
// A warped map as the papers draw it where triangles are large: cut up by the pipeline, the warp applied to each piece's
// corners. Measured beside the compute rasteriser's inverse, which frames use.
#include "tessellate.glsl"

layout(vertices = 3) out;

void main() {
  gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
  if (gl_InvocationID == 0) setLevels(gl_in[0].gl_Position, gl_in[1].gl_Position, gl_in[2].gl_Position);
}
