#version 460
#extension GL_GOOGLE_include_directive : require
// Places a cluster's vertices in the camera's view and names their draw and triangle.
#include "bindings.glsl"

layout(location = 0) in vec3 position;
layout(location = 4) in vec4 place[3];
layout(location = 1) in uint triangle;  // right at the provoking vertex, which is the one a flat varying takes
layout(location = 0) flat out uvec2 id;

void main() {
  id = uvec2(gl_InstanceIndex, triangle);
  gl_Position = frame.clipFromWorld * vec4(placed(Instance(place), position), 1);
}
