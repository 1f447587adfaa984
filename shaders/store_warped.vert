#version 460
#extension GL_GOOGLE_include_directive : require
// As store_depth.vert, for a warped map.
#include "store_warped.glsl"

layout(push_constant) uniform Push { uint view; };
layout(location = 0) in vec3 position;
layout(location = 4) in vec4 place[3];

void main() { gl_Position = warpedVertex(view, placed(Instance(place), position)); }
