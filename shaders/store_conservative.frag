#version 460
#extension GL_GOOGLE_include_directive : require
// What conservative.geom grew: the nearest depth of the triangle's plane in each texel, in a linear buffer.
#include "bindings.glsl"

layout(push_constant) uniform Push { uint view; };

layout(location = 0) in float depth;
layout(location = 1) flat in vec4 box;
layout(location = 2) flat in vec3 nearer;

void main() {
  const vec2 at = gl_FragCoord.xy;
  if (any(lessThan(at, box.xy)) || any(greaterThan(at, box.zw))) return;
  const uvec2 texel = uvec2(at);
  const uint index = plan.views[view].linearOffset + texel.y * plan.views[view].rectSize.x + texel.x;
  atomicMax(linearStore[index], floatBitsToUint(clamp(clamp(depth + nearer.x, nearer.y, nearer.z), 0, 1)));
}
