#version 460
#extension GL_GOOGLE_include_directive : require
// Counts the volumes that a sample is in: along the camera's ray, from the sample on, those that it leaves less those
// that it enters (z-fail [Everitt and Kilgard 2002]). Where faces lie to the sample is asked of their planes: depths
// of triangles that reach to infinity would be coarse.
#include "light.glsl"
#include "volumes.glsl"

layout(location = 0) flat in Face face;
layout(location = 0) out float outCount;  // added up: exact up to 2^24

bool isBehindSample() {
  if (face.atInfinity != 0) return true;
  const ViewSample s = sampleAt(ivec2(gl_FragCoord.xy));
  if (face.owner == uvec2(kNoInstance, 0)) return (dot(face.normal, s.wsPosition - face.corner) > 0) == (face.eye > 0);
  // A triangle doesn't hide itself.
  if (face.owner == uvec2(s.instance, s.triangle)) return true;
  const vec3 nearer = s.wsPosition + frame.biasWorld * towardsLight(s.wsPosition);
  return (dot(face.normal, nearer - face.corner) > 0) == (face.eye > 0);
}

void main() {
  if (!isBehindSample()) discard;
  outCount = gl_FrontFacing ? -face.enters : face.enters;
}
