// One direction of a separable box blur, as wide in light space for every view: texels at the box's ends count by the
// share that it covers, so that the result is continuous in its width.
#ifndef SUNDIAL_BLUR_GLSL
#define SUNDIAL_BLUR_GLSL
#include "bindings.glsl"

layout(push_constant) uniform Push { uint view; };
layout(location = 0) out vec4 outMoments;

// The most texels to each side that are read one by one: of wider boxes as many are read, evenly spread.
const float kMostTexels = 64;

vec4 blurred(sampler2DArray from, int layer, int axis) {
  const ivec2 at = ivec2(gl_FragCoord.xy), high = textureSize(from, 0).xy - 1;
  const float reach = 0.5 * max(frame.moments.lsBlur / plan.views[view].texelSize[axis], 1.0) - 0.5;
  const float stride = max(reach / kMostTexels, 1.0);
  const int steps = int(ceil(reach / stride));
  vec4 sum = vec4(0);
  float weights = 0;
  for (int i = -steps; i <= steps; ++i) {
    const float weight = min(1.0, reach / stride + 1 - abs(float(i)));
    ivec2 texel = at;
    texel[axis] += int(round(float(i) * stride));
    sum += weight * texelFetch(from, ivec3(clamp(texel, ivec2(0), high), layer), 0);
    weights += weight;
  }
  return sum / weights;
}

#endif
