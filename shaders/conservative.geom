#version 460
#extension GL_GOOGLE_include_directive : require
// Conservative rasterisation as [Lecocq et al. 2014, section 3.2] does it: a triangle that covers the centres of all
// texels that it touches [Hasselgren et al. 2005], its edges moved outwards by half a texel; what its corners then reach
// beyond the triangle's box is for the fragment shader to leave out. Of parallel light; measured beside the compute
// rasteriser, which frames use.
#include "bindings.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

layout(push_constant) uniform Push { uint view; };

layout(location = 0) out float outDepth;
layout(location = 1) flat out vec4 outBox;    // texels, of the centres that may be covered
layout(location = 2) flat out vec3 outNearer;  // what the depth gains within a texel, and its range

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

void main() {
  const vec2 size = vec2(plan.views[view].rectSize);
  vec2 p[3];
  vec3 z;
  for (int i = 0; i < 3; ++i) {
    p[i] = (0.5 * gl_in[i].gl_Position.xy + 0.5) * size;
    z[i] = gl_in[i].gl_Position.z;
  }
  const vec2 b = p[1] - p[0], c = p[2] - p[0];
  const float area = cross2(b, c);
  if (area == 0) return;
  const float turn = area > 0 ? 1.0 : -1.0;
  const vec2 slope = vec2((z.y - z.x) * c.y - (z.z - z.x) * b.y, (z.z - z.x) * b.x - (z.y - z.x) * c.x) / area;
  outBox = vec4(min(min(p[0], p[1]), p[2]) - 0.5, max(max(p[0], p[1]), p[2]) + 0.5);
  outNearer = vec3(0.5 * (abs(slope.x) + abs(slope.y)), min(min(z.x, z.y), z.z), max(max(z.x, z.y), z.z));

  // Lines of which dot(normal, place) + offset is at least 0 inside.
  vec3 lines[3];
  for (int i = 0; i < 3; ++i) {
    const vec2 along = p[(i + 1) % 3] - p[i], normal = turn * vec2(-along.y, along.x);
    lines[i] = vec3(normal, 0.5 * (abs(normal.x) + abs(normal.y)) - dot(normal, p[i]));
  }
  const vec4 boxes = outBox;
  const vec3 nearer = outNearer;
  for (int i = 0; i < 3; ++i) {
    const vec3 corner = cross(lines[(i + 2) % 3], lines[i]);
    const vec2 at = corner.xy / corner.z;
    outDepth = z.x + dot(slope, at - p[0]);
    outBox = boxes;
    outNearer = nearer;
    gl_Position = vec4(2 * at / size - 1, 0, 1);
    EmitVertex();
  }
  EndPrimitive();
}
