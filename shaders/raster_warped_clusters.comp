#version 460
#extension GL_GOOGLE_include_directive : require
// The first round in a warped map: every triangle of the clusters that reach a view, an invocation each. Those that cover
// much of the map are listed for the second.
#include "raster_warped.glsl"

#include "keep_depth.glsl"

layout(local_size_x = kMaxClusterTriangles) in;

const int kFewTexels = 24;

// An entry for each kColumnsPerEntry columns; which ones stands above the view.
void list(uint id, uint columns) {
  const uint entries = (columns + kColumnsPerEntry - 1) / kColumnsPerEntry;
  const uint place = atomicAdd(raster.listedCount[kKind], entries);
  if (place + entries > push.listedRoom) return;
  for (uint i = 0; i < entries; ++i)
    listed[kKind * push.listedRoom + place + i] = ListedTriangle(push.view | i << kViewBits, id);
  const uint groups = (place + entries - 1) / kEntriesPerGroup + 1;
  atomicMax(raster.listed[kKind].x, min(groups, kWorkgroupsInRow));
  atomicMax(raster.listed[kKind].y, (groups - 1) / kWorkgroupsInRow + 1);
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
  const WarpedTriangle t = warpedTriangle(push.view, corners);
  if (!t.drawn) return;
  // As many rows as in the middle, about.
  const ivec2 middle = rowsIn(t, uint(t.columns.x + t.columns.y) / 2);
  const int columns = t.columns.y - t.columns.x + 1;
  if (columns * max(middle.y - middle.x + 1, 1) > kFewTexels) {
    list(id, uint(columns));
    return;
  }
  const uint material = kMasked ? clusters[drawAt(command.firstInstance).cluster].material : 0;
  for (int x = t.columns.x; x <= t.columns.y; ++x) {
    const ivec2 rows = rowsIn(t, uint(x));
    for (int y = rows.x; y <= rows.y; ++y) keepIfCovered(id, t, corners, material, uvec2(x, y));
  }
}
