#version 460
#extension GL_GOOGLE_include_directive : require
// A volume's sides: from each edge of the silhouette to where the light's rays through it end. A sun's end in one point,
// so a side is a triangle; in a spot's light it has two ends, and a third triangle closes the volume there: those of
// all edges, drawn to one point at infinity, together make the far caps.
#include "volumes.glsl"

layout(location = 0) flat out Face face;

void main() {
  const uint perEdge = lightIsFar() ? 3 : 9;
  const SilhouetteEdge edge = silhouette.edges[gl_VertexIndex / perEdge];
  const uint corner = gl_VertexIndex % perEdge;
  const Instance place = instanceAt(edge.instance);
  const vec3 from = placed(place, vertexPosition(edge.from)), to = placed(place, vertexPosition(edge.to));

  // The order of corners is that of a side seen from outside of the volumes on the left of the edge.
  const vec4 a = vec4(volumeStart(from), 1), b = vec4(volumeStart(to), 1);
  vec4 at;
  if (lightIsFar())
    at = corner == 0 ? a : corner == 1 ? volumeEnd(from) : b;
  else {
    const uint which = corner % 3;
    const vec4 aEnd = volumeEnd(from), bEnd = volumeEnd(to);
    if (corner < 3) at = which == 0 ? a : which == 1 ? aEnd : bEnd;
    else if (corner < 6) at = which == 0 ? a : which == 1 ? bEnd : b;
    else at = which == 0 ? vec4(frame.lightKind == kLightSpot ? frame.wsLightDirection : vec3(0, -1, 0), 0) : which == 1 ? bEnd : aEnd;
  }
  gl_Position = frame.clipFromWorld * at;

  face.normal = cross(to - from, -volumeEnd(from).xyz);
  face.corner = from;
  face.eye = dot(face.normal, frame.wsEye - from);
  face.enters = float(edge.multiplicity);
  face.owner = uvec2(kNoInstance, 0);
  face.atInfinity = corner >= 6 ? 1 : 0;
}
