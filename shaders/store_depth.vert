#version 460
#extension GL_GOOGLE_include_directive : require
// storage=depth: places a cluster's vertices in a shadow view.
#include "bindings.glsl"

layout(push_constant) uniform Push { uint view; };
layout(location = 0) in vec3 position;
layout(location = 4) in vec4 place[3];

void main() {
  gl_Position = plan.views[view].shadowFromWorld * vec4(placed(Instance(place), position), 1);
}
