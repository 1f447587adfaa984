#version 460
#extension GL_GOOGLE_include_directive : require
// The second round in a warped map: a column of a listed band of a triangle an invocation.
#include "raster_warped.glsl"

#include "keep_depth.glsl"

layout(local_size_x = kEntriesPerGroup * kColumnsPerEntry) in;

void main() {
  const uint item = (gl_WorkGroupID.y * kWorkgroupsInRow + gl_WorkGroupID.x) * kEntriesPerGroup +
                    gl_LocalInvocationID.x / kColumnsPerEntry;
  // A list that overflowed has gaps: all is drawn again.
  if (item >= raster.listedCount[kKind] || raster.listedCount[kKind] > push.listedRoom) return;
  const ListedTriangle entry = listed[kKind * push.listedRoom + item];
  uint view, band, column;
  readEntry(entry.view, view, band, column);
  Corner corners[3];
  readTriangle(view, entry.id, corners);
  const WarpedTriangle t = warpedTriangle(view, corners);
  if (!t.drawn) return;
  const ivec2 columns = columnsOf(t, band);
  const int x = columns.x + int(column + gl_LocalInvocationID.x % kColumnsPerEntry);
  if (x > columns.y) return;
  const uint material = kMasked ? clusters[drawAt(entry.id / kMaxClusterTriangles).cluster].material : 0;
  const ivec2 rows = rowsIn(t, band, uint(x));
  for (int y = rows.x; y <= rows.y; ++y) keepIfCovered(entry.id, t, corners, material, uvec2(x, y));
}
