#version 460
#extension GL_GOOGLE_include_directive : require
// As store_depth.vert, for a map that is a part of the viewport.
#include "store_placed.glsl"

layout(location = 0) in vec3 position;
layout(location = 4) in vec4 place[3];

void main() { placeInStore(placed(Instance(place), position)); }
