#version 460
#extension GL_GOOGLE_include_directive : require
// storage=depth: places a cluster's vertices in a shadow view.
#include "bindings.glsl"

layout(push_constant) uniform Push { uint view; };
layout(location = 0) in vec3 position;

void main() {
  gl_Position = plan.views[view].shadowFromWorld * vec4(worldFromMesh(draws[gl_InstanceIndex].instance, position), 1);
}
