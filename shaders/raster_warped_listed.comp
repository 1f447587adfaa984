#version 460
#extension GL_GOOGLE_include_directive : require
// The second round in a warped map: a column of a listed triangle an invocation.
#include "raster_warped.glsl"

#include "keep_depth.glsl"

layout(local_size_x = kEntriesPerGroup * kColumnsPerEntry) in;

void main() {
  const uint item = (gl_WorkGroupID.y * kWorkgroupsInRow + gl_WorkGroupID.x) * kEntriesPerGroup +
                    gl_LocalInvocationID.x / kColumnsPerEntry;
  // A list that overflowed has gaps: all is drawn again.
  if (item >= raster.listedCount[kKind] || raster.listedCount[kKind] > push.listedRoom) return;
  const ListedTriangle entry = listed[kKind * push.listedRoom + item];
  const uint view = entry.view & ((1u << kViewBits) - 1);
  Corner corners[3];
  readTriangle(view, entry.id, corners);
  const WarpedTriangle t = warpedTriangle(view, corners);
  const int x = t.columns.x + int((entry.view >> kViewBits) * kColumnsPerEntry +
                                  gl_LocalInvocationID.x % kColumnsPerEntry);
  if (!t.drawn || x > t.columns.y) return;
  const uint material = kMasked ? clusters[drawAt(entry.id / kMaxClusterTriangles).cluster].material : 0;
  const ivec2 rows = rowsIn(t, uint(x));
  for (int y = rows.x; y <= rows.y; ++y) keepIfCovered(entry.id, t, corners, material, uvec2(x, y));
}
