#version 460
#extension GL_GOOGLE_include_directive : require
// Before the compute rasteriser: how many clusters each view has of each bucket, and empty lists.
#include "raster_state.glsl"

layout(local_size_x = kMaxShadowViews) in;

void main() {
  const uint view = gl_LocalInvocationID.x;
  for (uint bucket = 0; bucket < kBuckets; ++bucket) {
    const uint count = view < plan.viewCount ? counts[(1 + view) * kBuckets + bucket] : 0;
    raster.clusters[view * kBuckets + bucket] =
        DispatchCommand(min(count, kWorkgroupsInRow), (count + kWorkgroupsInRow - 1) / kWorkgroupsInRow, 1);
  }
  if (view != 0) return;
  for (uint kind = 0; kind < kRasterKinds; ++kind) {
    raster.listed[kind] = DispatchCommand(0, 1, 1);
    raster.bands[kind] = DispatchCommand(0, 0, 1);
    raster.listedCount[kind] = 0;
    raster.partCount[kind] = 0;
    raster.bandCount[kind] = 0;
  }
  raster.triangles = 0;
}
