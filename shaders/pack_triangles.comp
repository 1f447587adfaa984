#version 460
#extension GL_GOOGLE_include_directive : require
// storage=triangle: packs the triangles that listed texels hold, or those of all.
#include "map_triangle.glsl"
#include "wanted.glsl"

// A view that is known beforehand is read once, not by every texel for itself.
layout(constant_id = 0) const uint kViews = 1;
// Whether triangles may reach beyond the grid of corners. On lavapipe what is not needed is computed all the same.
layout(constant_id = 1) const bool kBeyond = true;
layout(constant_id = 2) const bool kAll = false;

// How far from a texel's centre, texels, its triangle is asked for: by samples of the eight about it.
const float kAsked = 1.5;

layout(local_size_x = kPackGroup) in;

layout(set = 0, binding = kBindHeldWritten, rgba32ui) writeonly uniform uimageBuffer held;

uvec4 packedAt(uint index) {
  uint view = 0;
  while (view < kViews && index - plan.views[view].linearOffset >=
                              plan.views[view].rectSize.x * plan.views[view].rectSize.y)
    ++view;
  if (view >= plan.viewCount) return uvec4(0);
  if (kViews == 1) view = 0;
  const uvec2 nearest = texelFetch(linearTexels, int(index)).xy;  // id, depth
  if (nearest.y == 0) return uvec4(0);
  const uint within = index - plan.views[view].linearOffset;
  const uvec2 size = plan.views[view].rectSize;
  const vec2 centre = (vec2(within % size.x, within / size.x) + 0.5) / vec2(size);
  uvec2 owner;
  const MapTriangle triangle = mapTriangle(view, nearest.x, centre, owner);
  return packedTriangle(kBeyond ? onGrid(triangle, centre, kAsked / vec2(size)) : triangle, texelMetric(view));
}

void main() {
  const uint count = kAll ? uint(imageSize(held)) : wanted.count;
  for (uint item = gl_GlobalInvocationID.x; item < count; item += kPackGroup * kPackGroups) {
    const uint index = kAll ? item : wantedTexel(item);
    imageStore(held, int(index), packedAt(index));
  }
}
