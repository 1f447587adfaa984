// The third round: bands of large triangles, a workgroup each, a row an invocation. Neighbouring rows cover about as many
// texels, so that no invocation waits long for another.
#include "raster.glsl"

layout(local_size_x = kBandRows) in;

void main() {
  const uint item = gl_WorkGroupID.y * kWorkgroupsInRow + gl_WorkGroupID.x;
  if (item >= raster.bandCount[kKind]) return;
  // Lists that overflowed have gaps: all is drawn again.
  if (raster.bandCount[kKind] > push.bandRoom || raster.partCount[kKind] > push.partRoom) return;
  const RasterBand band = bands[kKind * push.bandRoom + item];
  const RasterPart part = parts[kKind * push.partRoom + band.part];
  const ivec2 grid[3] = {ivec2(part.x[0], part.y[0]), ivec2(part.x[1], part.y[1]), ivec2(part.x[2], part.y[2])};
  Varying v;
  v.from = ivec2(part.box[0], part.box[1]);
  v.depth = part.depth.x;
  v.depthSlope = part.depth.yz;
  v.depthRange = part.depthRange;
  if (kMasked) {
    v.attributes = part.attributes[0];
    v.attributesRight = part.attributes[1];
    v.attributesDown = part.attributes[2];
  }
  const uint material = kMasked ? clusters[drawAt(part.id / kMaxClusterTriangles).cluster].material : 0;

  const int y = part.box[1] + int(band.band * kBandRows + gl_LocalInvocationID.x);
  const int end = y <= part.box[3] ? part.box[2] + 1 : 0;
  for (int x = part.box[0]; x < end; x += int(kSegmentTexels)) {
    const Edges e = edgesFar(grid, ivec2(x, y));
    fillSpan(part.view, part.id, ivec2(x, y), spanOf(e.at, e.right, 1 / vec3(e.right), min(end - x, int(kSegmentTexels))),
             v, material);
  }
}
