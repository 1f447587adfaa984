// The third round: bands of large triangles, a workgroup each, a row an invocation. Neighbouring rows cover about as many
// texels, so that no invocation waits long for another.
#include "raster_fill.glsl"

layout(local_size_x = kBandRows) in;

// The covered ones of some texels of a row, counted from the one that `e` is at: from x to y, without y.
ivec2 spanOf(Edges e, int texels) {
  ivec2 span = ivec2(0, texels);
  for (int i = 0; i < 3; ++i) {
    // By a division of floats, which is nearly right, and single steps.
    int edge = int(clamp(-float(e.at[i]) / float(e.right[i]), -1.0, float(texels)));
    if (e.right[i] > 0) {
      edge += e.at[i] + e.right[i] * edge < 0 ? 1 : 0;
      edge += e.at[i] + e.right[i] * edge < 0 ? 1 : 0;
      span.x = max(span.x, edge);
    } else if (e.right[i] < 0) {
      edge += e.at[i] + e.right[i] * edge >= 0 ? 1 : 0;
      edge += e.at[i] + e.right[i] * edge >= 0 ? 1 : 0;
      span.y = min(span.y, edge);
    } else if (e.at[i] < 0) {
      span.y = 0;
    }
  }
  return span;
}

void main() {
  const uint item = gl_WorkGroupID.y * kWorkgroupsInRow + gl_WorkGroupID.x;
  if (item >= raster.bandCount[kKind]) return;
  // Lists that overflowed have gaps: all is drawn again.
  if (raster.bandCount[kKind] > push.bandRoom || raster.partCount[kKind] > push.partRoom) return;
  const RasterBand band = bands[kKind * push.bandRoom + item];
  const RasterPart part = parts[kKind * push.partRoom + band.part];
  const ivec2 grid[3] = {ivec2(part.x[0], part.y[0]), ivec2(part.x[1], part.y[1]), ivec2(part.x[2], part.y[2])};
  Varying v;
  v.depth = part.depth;
  v.depthHigh = highPart(v.depth.yz);
  v.depthAtMost = part.depthAtMost;
  if (kMasked) v.attributes = part.attributes;
  const ivec2 offset = ivec2(plan.views[part.view].rectOffset);
  if (kPrefersCovering) {
    vec2 corners[3];
    for (int i = 0; i < 3; ++i) corners[i] = vec2(grid[i]) / kSubTexels + vec2(offset);
    coverOver(v, part.view, corners);
  }
  const uint material = materialOf(part.id);

  const int y = part.box[1] + int(band.band * kBandRows + gl_LocalInvocationID.x);
  const int end = y <= part.box[3] ? part.box[2] + 1 : 0;
  for (int x = part.box[0]; x < end; x += int(kSegmentTexels)) {
    const Edges e = edgesFrom(grid, sidesFar(grid, ivec2(x, y) * int(kSubTexels)));
    const ivec2 span = spanOf(e, min(end - x, int(kSegmentTexels)));
    const uint index = indexOf(part.view, ivec2(x, y));
    for (int i = span.x; i < span.y; ++i) fillTexel(part.id, index + uint(i), vec2(offset + ivec2(x + i, y)), v, material);
  }
}
