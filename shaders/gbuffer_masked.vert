#version 460
#extension GL_GOOGLE_include_directive : require
// As gbuffer.vert, with what the alpha test needs.
#include "bindings.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in uint triangle;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
layout(location = 4) in vec4 place[3];
layout(location = 0) flat out uvec2 id;
layout(location = 1) out vec2 outUv;
layout(location = 2) out float outAlpha;
layout(location = 3) flat out uint outMaterial;

void main() {
  id = uvec2(gl_InstanceIndex, triangle);
  outUv = uv;
  outAlpha = colour.a;
  outMaterial = clusters[drawAt(gl_InstanceIndex).cluster].material;
  gl_Position = frame.clipFromWorld * vec4(placed(Instance(place), position), 1);
}
