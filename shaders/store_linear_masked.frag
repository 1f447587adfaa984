#version 460
#extension GL_GOOGLE_include_directive : require
#include "material.glsl"
#include "store_linear.glsl"

layout(push_constant) uniform Push { uint view; };
layout(location = 0) in vec2 uv;
layout(location = 1) in float alpha;
layout(location = 2) flat in uint material;

void main() {
  if (isHole(materials[material], uv, vec4(1, 1, 1, alpha))) discard;
  keepNearest(view);
}
