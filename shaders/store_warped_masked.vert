#version 460
#extension GL_GOOGLE_include_directive : require
// As store_depth_masked.vert, for a warped map.
#include "store_warped.glsl"

layout(push_constant) uniform Push { uint view; };
layout(location = 0) in vec3 position;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
layout(location = 4) in vec4 place[3];
layout(location = 0) out vec2 outUv;
layout(location = 1) out float outAlpha;
layout(location = 2) flat out uint outMaterial;

void main() {
  outUv = uv;
  outAlpha = colour.a;
  outMaterial = clusters[drawAt(gl_InstanceIndex).cluster].material;
  gl_Position = warpedVertex(view, placed(Instance(place), position));
}
