// A triangle of the scene on a view's map.
#ifndef SUNDIAL_MAP_TRIANGLE_GLSL
#define SUNDIAL_MAP_TRIANGLE_GLSL
#include "raster_triangle_id.glsl"
#include "shared/triangle_texel.h"

// `place` is where on the map its plane's depth is asked for; `owner` becomes its instance and index. A corner behind a
// spot light moves along an edge to just before it.
MapTriangle mapTriangle(uint view, uint id, vec2 place, out uvec2 owner) {
  const uint instance = drawAt(id / kMaxClusterTriangles).instance, index = triangleOf(id);
  owner = uvec2(instance, index);
  const Instance at = instanceAt(instance);
  const Triangle triangle = triangleAt(index);
  vec4 clip[3];
  for (int i = 0; i < 3; ++i)
    clip[i] = plan.views[view].shadowFromWorld * vec4(placed(at, vertexPosition(triangle.vertices[i])), 1);
  const float least = 1e-3 * max(max(clip[0].w, clip[1].w), clip[2].w);
  MapTriangle m;
  vec3 corners[3];
  for (int i = 0; i < 3; ++i) {
    vec4 corner = clip[i];
    if (corner.w < least) {
      const vec4 next = clip[(i + 1) % 3], other = clip[(i + 2) % 3];
      const vec4 before = next.w > least ? next : other;
      corner = mix(before, corner, (before.w - least) / (before.w - corner.w));
    }
    corners[i] = corner.xyz / corner.w;
    m.corners[i] = 0.5 * corners[i].xy + 0.5;
  }
  const vec2 b = m.corners[1] - m.corners[0], c = m.corners[2] - m.corners[0];
  const float area = b.x * c.y - b.y * c.x;
  const vec2 depths = vec2(corners[1].z, corners[2].z) - corners[0].z;
  m.slope = area != 0 ? vec2(depths.x * c.y - depths.y * b.y, depths.y * b.x - depths.x * c.x) / area : vec2(0);
  m.depth = corners[0].z + dot(m.slope, place - m.corners[0]);
  return m;
}

#endif
