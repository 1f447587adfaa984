#version 460
#extension GL_GOOGLE_include_directive : require
#include "material.glsl"

layout(location = 0) flat in uvec2 id;
layout(location = 1) in vec2 uv;
layout(location = 2) in float alpha;
layout(location = 3) flat in uint material;
layout(location = 0) out uvec2 outId;

void main() {
  if (isHole(materials[material], uv, vec4(1, 1, 1, alpha))) discard;
  outId = id;
}
