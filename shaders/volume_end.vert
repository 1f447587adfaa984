#version 460
#extension GL_GOOGLE_include_directive : require
// A volume's far cap, of a light at a place: the triangle at infinity, where the light's rays through it end. A ray of the
// camera that goes the same way ends in the volume, so it leaves it there.
#include "volumes.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in uint triangle;  // right at the provoking vertex, which is the one a flat varying takes
layout(location = 4) in vec4 place[3];
layout(location = 0) flat out Face face;

void main() {
  const Instance instance = Instance(place);
  gl_Position = frame.clipFromWorld * volumeEnd(placed(instance, position));

  // Seen from the light, and so from the camera, corners run counter-clockwise where it is on that side.
  face.enters = -float(facing(triangle, meshLight(instance)));
  face.atInfinity = 1;
  face.normal = face.corner = vec3(0);
  face.eye = 0;
  face.owner = uvec2(kNoInstance, 0);
}
