#version 460
#extension GL_GOOGLE_include_directive : require
// A rectangle over a view's map, at the depth of nothing: clears what of the store's image the plan uses.
#include "bindings.glsl"

layout(push_constant) uniform Push { uint view; };

void main() {
  const uint kCorners[6] = uint[6](0, 1, 2, 2, 1, 3);
  const uint at = kCorners[gl_VertexIndex];
  const vec2 corner = vec2(at & 1, at >> 1);
  const vec2 texel = vec2(plan.views[view].rectOffset) + corner * vec2(plan.views[view].rectSize);
  gl_Position = vec4(2 * texel / vec2(frame.settings.viewport) - 1, 0, 1);
}
