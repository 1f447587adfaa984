#version 460
#extension GL_GOOGLE_include_directive : require
// First half of culling: a bit for each draw that reaches into the view.
#include "cull.glsl"

// Planes of the view's frustum, pointing inwards: left, right, top, bottom, far; and near for the camera alone,
// because casters before a shadow view's near plane still cast.
vec4 planes[6];
bool drawsAll;

void makePlanes(mat4 m, bool camera) {
  const mat4 rows = transpose(m);
  planes[0] = rows[3] + rows[0];
  planes[1] = rows[3] - rows[0];
  planes[2] = rows[3] + rows[1];
  planes[3] = rows[3] - rows[1];
  planes[4] = rows[2];
  planes[5] = camera ? rows[3] - rows[2] : vec4(0);
}

bool reaches(Draw draw) {
  if (draw.instance == kNoInstance) return false;
  if (drawsAll) return true;
  const Cluster cluster = clusters[draw.cluster];
  const Instance place = instanceAt(draw.instance);
  const vec3 centre = 0.5 * (cluster.boundsMin + cluster.boundsMax);
  const vec3 extent = 0.5 * (cluster.boundsMax - cluster.boundsMin);
  const vec3 wsCentre = placed(place, centre);
  const vec3 wsExtent = vec3(dot(abs(place.worldFromMesh[0].xyz), extent), dot(abs(place.worldFromMesh[1].xyz), extent),
                             dot(abs(place.worldFromMesh[2].xyz), extent));
  for (int i = 0; i < 6; ++i)
    if (dot(planes[i].xyz, wsCentre) + dot(abs(planes[i].xyz), wsExtent) + planes[i].w < 0) return false;
  return true;
}

void main() {
  const uint chunk = gl_GlobalInvocationID.x;
  if (chunk >= chunkCount()) return;
  const uint slot = firstSlot + gl_WorkGroupID.y;
  uvec2 bits = uvec2(0);
  const bool camera = slot == kCameraSlot;
  if (camera || (slot <= plan.viewCount && plan.views[slot - 1].empty == 0)) {
    drawsAll = !camera && frame.settings.drawsAll != 0;
    makePlanes(camera ? frame.clipFromWorld : plan.views[slot - 1].shadowFromWorld, camera);
    for (uint i = 0; i < kDrawsPerChunk; ++i)
      if (reaches(drawAt(chunk * kDrawsPerChunk + i))) bits[i / 32] |= 1u << (i % 32);
  }
  visible[slot * chunkCount() + chunk] = bits;
}
