#version 460
#extension GL_GOOGLE_include_directive : require
// The first round in a warped map: every triangle of the clusters that reach a view, an invocation each. Those that cover
// much of the map are listed for the second.
#include "raster_warped.glsl"

#include "keep_depth.glsl"

layout(local_size_x = kMaxClusterTriangles) in;

const int kFewTexels = 24;

// An entry for each kColumnsPerEntry columns of a band.
void list(uint id, uint band, uint columns) {
  const uint entries = (columns + kColumnsPerEntry - 1) / kColumnsPerEntry;
  const uint place = atomicAdd(raster.listedCount[kKind], entries);
  if (place + entries > push.listedRoom) return;
  for (uint i = 0; i < entries; ++i)
    listed[kKind * push.listedRoom + place + i] = ListedTriangle(entryOf(push.view, band, i), id);
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
  const uint material = kMasked ? clusters[drawAt(command.firstInstance).cluster].material : 0;
  const uint last = bandOf(t.high.y);
  for (uint band = bandOf(t.low.y); band <= last; ++band) {
    const ivec2 columns = columnsOf(t, band);
    if (columns.x > columns.y) continue;
    // As many rows as in the middle, about.
    const ivec2 middle = rowsIn(t, band, uint(columns.x + columns.y) / 2);
    const int width = columns.y - columns.x + 1;
    if (width * max(middle.y - middle.x + 1, 1) > kFewTexels) {
      list(id, band, uint(width));
      continue;
    }
    for (int x = columns.x; x <= columns.y; ++x) {
      const ivec2 rows = rowsIn(t, band, uint(x));
      for (int y = rows.x; y <= rows.y; ++y) keepIfCovered(id, t, corners, material, uvec2(x, y));
    }
  }
}
