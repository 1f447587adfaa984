#version 460
#extension GL_GOOGLE_include_directive : require
// The silhouette: of each draw's edges those at which as many volumes don't end as begin, if they can be seen.
#include "volumes.glsl"

layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
  uint firstDraw;
  uint drawCount;
};

// Whether none of a side's corners is within one of the frustum's four planes through the eye: clipping would leave
// nothing of it.
bool isOutside(mat4 rows, vec4 a, vec4 b, vec4 c, vec4 d) {
  for (int i = 0; i < 4; ++i) {
    const vec4 plane = rows[3] + (i % 2 == 0 ? rows[i / 2] : -rows[i / 2]);
    if (dot(plane, a) < 0 && dot(plane, b) < 0 && dot(plane, c) < 0 && dot(plane, d) < 0) return true;
  }
  return false;
}

void main() {
  if (gl_GlobalInvocationID.x >= drawCount) return;
  const Draw draw = drawAt(firstDraw + gl_GlobalInvocationID.x);
  if (draw.instance == kNoInstance) return;
  const Instance place = instanceAt(draw.instance);
  const vec4 light = meshLight(place);
  const mat4 rows = transpose(frame.clipFromWorld);
  const uvec2 range = texelFetch(clusterEdgeTexels, int(draw.cluster)).xy;
  for (uint i = range.x; i < range.x + range.y; ++i) {
    const uvec4 edge = texelFetch(edgeTexels, int(i));
    int multiplicity = 0;
    for (uint k = edge.z; k < edge.z + edge.w; ++k) {
      const uint side = texelFetch(edgeSideTexels, int(k)).x;
      multiplicity += facing(side >> 1, light) * ((side & 1) == 0 ? 1 : -1);
    }
    if (multiplicity == 0) continue;
    const vec3 from = placed(place, vertexPosition(edge.x)), to = placed(place, vertexPosition(edge.y));
    if (isOutside(rows, vec4(volumeStart(from), 1), vec4(volumeStart(to), 1), volumeEnd(from), volumeEnd(to))) continue;
    const uint at = atomicAdd(silhouette.draw.vertexCount, cornersPerEdge()) / cornersPerEdge();
    silhouette.edges[at] = SilhouetteEdge(edge.x, edge.y, draw.instance, multiplicity);
  }
}
