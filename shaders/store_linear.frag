#version 460
#extension GL_GOOGLE_include_directive : require
// storage=linear: the nearest depth of each texel, kept by the atomic maximum of its bits [Alecu 2014, listing 3.1].
#include "store_linear.glsl"

layout(push_constant) uniform Push { uint view; };

void main() { keepNearest(view); }
