// The first round: every triangle of the clusters that reach a view, an invocation each. Small ones are drawn at once;
// those that are large, or reach beyond the map, are listed for the second.
#include "raster_fill.glsl"

layout(local_size_x = kMaxClusterTriangles) in;

const uint kListedPerGroup = 64;

void list(uint id) {
  const uint place = atomicAdd(raster.listedCount[kKind], 1);
  if (place >= push.listedRoom) return;
  listed[kKind * push.listedRoom + place] = ListedTriangle(push.view, id);
  atomicMax(raster.listed[kKind].x, place / kListedPerGroup + 1);
}

// Sides of the map that a corner lies beyond, a bit each.
uint beyond(vec4 clip) {
  return (clip.x > clip.w ? 1u : 0u) | (clip.x + clip.w < 0 ? 2u : 0u) | (clip.y > clip.w ? 4u : 0u) |
         (clip.y + clip.w < 0 ? 8u : 0u);
}

void main() {
  const uint item = gl_WorkGroupID.y * kWorkgroupsInRow + gl_WorkGroupID.x;
  const uint slot = 1 + push.view;
  if (item >= counts[slot * kBuckets + push.bucket]) return;
  const DrawCommand command =
      commands[slot * frame.drawCount + frame.drawBuckets[push.bucket].x * kDrawsPerChunk + item];
  const uint triangle = gl_LocalInvocationID.x;
  if (triangle == 0) atomicAdd(raster.triangles, command.indexCount / 3);
  if (3 * triangle >= command.indexCount) return;

  const uint id = triangleId(command.firstInstance, triangle);
  Corner corners[3];
  readTriangle(push.view, id, corners);
  const uint a = beyond(corners[0].clip), b = beyond(corners[1].clip), c = beyond(corners[2].clip);
  if ((a & b & c) != 0) return;
  const bool inside = (a | b | c) == 0;

  Placed p[3];
  for (int i = 0; i < 3; ++i) p[i] = placedIn(push.view, corners[i]);
  const ivec4 box = texelBox(push.view, p);
  if (inside && isEmpty(box)) return;
  if (inside && isSmall(p, box))
    drawSmall(push.view, id, p, box, materialOf(id));
  else
    list(id);
}
