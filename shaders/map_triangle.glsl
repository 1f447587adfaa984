// A triangle of the scene on a view's map.
#ifndef SUNDIAL_MAP_TRIANGLE_GLSL
#define SUNDIAL_MAP_TRIANGLE_GLSL
#include "raster_triangle_id.glsl"
#include "shared/triangle_texel.h"
#include "view_space.glsl"

// In an image of the sun light space's depth is a length, in the others the reciprocal of one.
TexelMetric texelMetric(uint view) {
  const vec3 lsMin = plan.views[view].lsMin, lsMax = plan.views[view].lsMax;
  return TexelMetric(lsMax.xy - lsMin.xy, lsMax.z, lsMin.z, frame.lightKind != kLightDirectional);
}

// `place` is where on the map its plane's depth is asked for; `owner` becomes its instance and index. A corner behind a
// spot light moves along an edge to just before it.
MapTriangle mapTriangle(uint view, uint id, vec2 place, out uvec2 owner) {
  const uint instance = drawAt(id / kMaxClusterTriangles).instance, index = triangleOf(id);
  owner = uvec2(instance, index);
  const Instance at = instanceAt(instance);
  const Triangle triangle = triangleAt(index);
  vec3 ws[3];
  vec4 clip[3];
  for (int i = 0; i < 3; ++i) {
    ws[i] = placed(at, vertexPosition(triangle.vertices[i]));
    clip[i] = plan.views[view].shadowFromWorld * vec4(ws[i], 1);
  }
  const float least = 1e-3 * max(max(clip[0].w, clip[1].w), clip[2].w);
  MapTriangle m;
  for (int i = 0; i < 3; ++i) {
    vec4 corner = clip[i];
    if (corner.w < least) {
      const vec4 next = clip[(i + 1) % 3], other = clip[(i + 2) % 3];
      const vec4 before = next.w > least ? next : other;
      corner = mix(before, corner, (before.w - least) / (before.w - corner.w));
    }
    m.corners[i] = 0.5 * corner.xy / corner.w + 0.5;
  }

  // By its plane, as the receiver's (receiver.glsl): a corner far away would make a coarse starting point.
  const vec3 lsMin = plan.views[view].lsMin, lsSize = plan.views[view].lsMax - lsMin;
  const vec3 normal = cross(normalize(ws[1] - ws[0]), normalize(ws[2] - ws[0]));
  const vec4 plane = planeInView(view, normal, ws[0]);
  const vec2 ls = lsMin.xy + vec2(place.x, 1 - place.y) * lsSize.xy;  // rows run down
  const bool hasSlope = plane.z != 0;
  m.slope = hasSlope ? -plane.xy / plane.z * lsSize.xy * vec2(1, -1) / lsSize.z : vec2(0);
  m.depth = hasSlope ? (-(dot(plane.xy, ls) + plane.w) / plane.z - lsMin.z) / lsSize.z : clip[0].z / clip[0].w;
  return m;
}

#endif
