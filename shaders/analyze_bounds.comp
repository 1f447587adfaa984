#version 460
#extension GL_GOOGLE_include_directive : require
// volume=samples: the box of the view samples in light space. Sixteen pixels a thread, then the subgroup, then one
// atomic: on lavapipe a tree in shared memory costs twenty times as much.
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "light.glsl"
#include "ordered.glsl"

layout(local_size_x = 64) in;
const uint kPixelsPerThread = 16;

void main() {
  const uint pixelCount = frame.imageSize.x * frame.imageSize.y;
  const uint first = gl_WorkGroupID.x * 64 * kPixelsPerThread + gl_LocalInvocationID.x;
  vec3 low = vec3(1e38), high = vec3(-1e38);
  for (uint i = 0; i < kPixelsPerThread; ++i) {
    const uint pixel = first + i * 64;
    if (pixel >= pixelCount) break;
    const ViewSample s = sampleAt(ivec2(pixel % frame.imageSize.x, pixel / frame.imageSize.x));
    if (!facesLight(s)) continue;
    const vec4 ls = frame.lightFromWorld * vec4(s.wsPosition, 1);
    low = min(low, ls.xyz / ls.w);
    high = max(high, ls.xyz / ls.w);
  }
  low = subgroupMin(low);
  high = subgroupMax(high);
  if (!subgroupElect() || low.x > high.x) return;
  for (int axis = 0; axis < 3; ++axis) {
    atomicMin(analysis.lsBoundsMin[axis], orderedFromFloat(low[axis]));
    atomicMax(analysis.lsBoundsMax[axis], orderedFromFloat(high[axis]));
  }
}
