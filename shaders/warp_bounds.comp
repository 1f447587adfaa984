#version 460
#extension GL_GOOGLE_include_directive : require
// The least and greatest values of groups of the rows' functions, knot by knot: groups of eight, of sixteen, and so on.
#include "warp.glsl"

layout(local_size_x = 64) in;

void main() {
  const uint knot = gl_GlobalInvocationID.x, view = gl_WorkGroupID.z;
  if (knot >= knots(false) || plan.views[view].empty != 0) return;
  const uint last = lastLevel();
  for (uint level = kFirstLevel; level <= last; ++level)
    for (uint group = 0; group < groupsOf(level); ++group) {
      float low = 1e30, high = -1e30;
      if (level == kFirstLevel) {
        const uint end = min((group + 1) << level, functions(false));
        for (uint f = group << level; f < end; ++f) {
          const float value = warpTexel(functionAt(view, f, false) + knot).x;
          low = min(low, value);
          high = max(high, value);
        }
      } else {
        const uint end = min(2 * group + 2, groupsOf(level - 1));
        for (uint below = 2 * group; below < end; ++below) {
          const vec2 bound = warps[boundAt(view, level - 1, below) + knot];  // this invocation's own
          low = min(low, bound.x);
          high = max(high, bound.y);
        }
      }
      warps[boundAt(view, level, group) + knot] = vec2(low, high);
    }
}
