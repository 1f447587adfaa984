#version 460
#extension GL_GOOGLE_include_directive : require
// A volume's cap: the triangle itself.
#include "volumes.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in uint triangle;  // right at the provoking vertex, which is the one a flat varying takes
layout(location = 4) in vec4 place[3];
layout(location = 0) flat out Face face;

void main() {
  const Instance instance = Instance(place);
  gl_Position = frame.clipFromWorld * vec4(volumeStart(placed(instance, position)), 1);

  const Triangle corners = triangleAt(triangle);
  const vec3 a = placed(instance, vertexPosition(corners.vertices[0]));
  const vec3 b = placed(instance, vertexPosition(corners.vertices[1]));
  const vec3 c = placed(instance, vertexPosition(corners.vertices[2]));
  face.normal = cross(b - a, c - a);
  face.corner = a;
  face.eye = dot(face.normal, frame.wsEye - volumeStart(a));
  face.enters = float(facing(triangle, meshLight(instance)));
  face.owner = uvec2(drawAt(gl_InstanceIndex).instance, triangle);
  face.atInfinity = 0;
}
