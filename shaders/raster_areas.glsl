// The third round: areas of large triangles, a workgroup each, a block of texels an invocation.
#include "raster.glsl"

layout(local_size_x = kBlocksAcross, local_size_y = kBlocksAcross) in;

void main() {
  const uint item = gl_WorkGroupID.y * kWorkgroupsInRow + gl_WorkGroupID.x;
  if (item >= raster.areaCount[kKind]) return;
  // Lists that overflowed have gaps: all is drawn again.
  if (raster.areaCount[kKind] > push.areaRoom || raster.partCount[kKind] > push.partRoom) return;
  const RasterArea area = areas[kKind * push.areaRoom + item];
  const RasterPart part = parts[kKind * push.partRoom + area.part];
  const ivec2 from = ivec2(part.box[0], part.box[1]), to = ivec2(part.box[2], part.box[3]);
  const ivec2 first = from + int(kAreaSide) * ivec2(area.place & 0xffffu, area.place >> 16) +
                      int(kBlockSide) * ivec2(gl_LocalInvocationID.xy);
  ivec4 box = ivec4(first, min(first + int(kBlockSide) - 1, to));

  const Edges e =
      edgesFar(ivec2[3](ivec2(part.x[0], part.y[0]), ivec2(part.x[1], part.y[1]), ivec2(part.x[2], part.y[2])), first);
  // Wholly outside of an edge.
  const ivec3 most = e.at + int(kBlockSide - 1) * (max(e.right, 0) + max(e.down, 0));
  if ((most.x | most.y | most.z) < 0) box.w = box.y - 1;
  Varying v;
  v.from = from;
  v.depth = part.depth.x;
  v.depthSlope = part.depth.yz;
  v.depthRange = part.depthRange;
  if (kMasked) {
    v.attributes = part.attributes[0];
    v.attributesRight = part.attributes[1];
    v.attributesDown = part.attributes[2];
  }
  fill(part.view, part.id, e, v, box,
       kMasked ? clusters[drawAt(part.id / kMaxClusterTriangles).cluster].material : 0);
}
