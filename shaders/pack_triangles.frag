#version 460
#extension GL_GOOGLE_include_directive : require
// storage=triangle: packs the triangle that is nearest to the light in each texel. All views' texels lie one behind the
// other in rows of kHeldPitch.
#include "map_triangle.glsl"

// A view that is known beforehand is read once, not by every texel for itself.
layout(constant_id = 0) const uint kViews = 1;
// Whether triangles may reach beyond the grid of corners. On lavapipe what is not needed is computed all the same.
layout(constant_id = 1) const bool kBeyond = true;

layout(location = 0) out uvec4 outTriangle;

void main() {
  const uint index = uint(gl_FragCoord.y) * kHeldPitch + uint(gl_FragCoord.x);
  outTriangle = uvec4(0);
  uint view = 0;
  while (view < kViews && index - plan.views[view].linearOffset >=
                              plan.views[view].rectSize.x * plan.views[view].rectSize.y)
    ++view;
  if (view >= plan.viewCount) return;
  if (kViews == 1) view = 0;
  const uvec2 nearest = texelFetch(linearTexels, int(index)).xy;  // id, depth
  if (nearest.y == 0) return;
  const uint within = index - plan.views[view].linearOffset;
  const uvec2 size = plan.views[view].rectSize;
  const vec2 centre = (vec2(within % size.x, within / size.x) + 0.5) / vec2(size);
  uvec2 owner;
  const MapTriangle triangle = mapTriangle(view, nearest.x, centre, owner);
  outTriangle = kBeyond ? packedTriangle(onGrid(triangle, centre)) : packedTriangle(triangle);
}
