// A pass over the view samples: sixteen pixels a thread, then the subgroup, then one atomic. On lavapipe a tree in
// shared memory costs twenty times as much.
#ifndef SUNDIAL_ANALYZE_GLSL
#define SUNDIAL_ANALYZE_GLSL
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_vote : require
#include "light.glsl"
#include "ordered.glsl"
#include "shared/samples.h"
#include "view_depth.glsl"

layout(local_size_x = kSampleGroup) in;

// Subgroups read neighbouring pixels, a row after another.
uint firstPixel() { return gl_WorkGroupID.x * kSampleGroup * kSamplesPerInvocation + gl_LocalInvocationID.x; }
uint pixelCount() { return frame.imageSize.x * frame.imageSize.y; }
ViewSample sampleOf(uint pixel) {
  return sampleAt(ivec2(pixel % frame.imageSize.x, pixel / frame.imageSize.x));
}

#endif
