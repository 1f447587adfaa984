#version 460
#extension GL_GOOGLE_include_directive : require
// A volume's sides: from each edge of the silhouette to where the light's rays through it end. A sun's end in one point,
// so a side is a triangle; those of a light at a place have two ends.
#include "volumes.glsl"

layout(location = 0) flat out Face face;

void main() {
  const SilhouetteEdge edge = silhouette.edges[gl_VertexIndex / cornersPerEdge()];
  const uint corner = gl_VertexIndex % cornersPerEdge();
  const Instance place = instanceAt(edge.instance);
  const vec3 from = placed(place, vertexPosition(edge.from)), to = placed(place, vertexPosition(edge.to));

  // The order of corners is that of a side seen from outside of the volumes on the left of the edge.
  const vec4 a = vec4(volumeStart(from), 1), b = vec4(volumeStart(to), 1);
  const vec4 aEnd = volumeEnd(from), bEnd = volumeEnd(to);
  vec4 at;
  if (corner == 0 || corner == 3) at = a;
  else if (corner == 1) at = aEnd;
  else if (corner == 4) at = bEnd;
  else at = lightIsFar() || corner == 5 ? b : bEnd;
  gl_Position = frame.clipFromWorld * at;

  face.normal = cross(to - from, -volumeEnd(from).xyz);
  face.corner = from;
  face.eye = dot(face.normal, frame.wsEye - from);
  face.enters = float(edge.multiplicity);
  face.owner = uvec2(kNoInstance, 0);
  face.atInfinity = 0;
}
