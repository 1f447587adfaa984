#version 460
#extension GL_GOOGLE_include_directive : require
// partition=single: one shadow view around the volume.
#include "bindings.glsl"
#include "ordered.glsl"

layout(local_size_x = 1) in;

layout(constant_id = 0) const uint kFromSamples = 0;  // 1: volume=samples, 0: the host's bounds

void main() {
  vec3 low = frame.lsBoundsMin, high = frame.lsBoundsMax;
  bool empty = any(greaterThan(low, high));
  if (kFromSamples == 1) {
    empty = analysis.lsBoundsMin[0] > analysis.lsBoundsMax[0];
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = floatFromOrdered(analysis.lsBoundsMin[axis]);
      high[axis] = floatFromOrdered(analysis.lsBoundsMax[axis]);
    }
    // Up to the scene's nearest caster: one before the near plane would be clamped to depth 1, and a receiver that bias
    // or its own slope carries there would pass for lit.
    high.z = max(high.z, frame.lsBoundsMax.z);
  }
  if (empty) {
    low = vec3(-1);
    high = vec3(1);
  }

  // A texel of border, so that a sample on the rim has a whole texel; some depth, so that a flat volume has any.
  const vec2 size = vec2(frame.storeSize);
  const vec3 centre = 0.5 * (low + high);
  vec3 half_ = max(0.5 * (high - low), 1e-6 * max(max(abs(centre.x), abs(centre.y)), abs(centre.z)) + 1e-30);
  half_.xy *= size / (size - 2);
  half_.z *= 1.001;
  const float farZ = frame.lightKind == kLightSpot ? max(centre.z - half_.z, 0.0) : centre.z - half_.z;
  const float nearZ = centre.z + half_.z;

  // shadow = scale * light + offset * w: image rows run down, depth runs from 0 (far) to 1 (near).
  const vec3 scale = vec3(1 / half_.x, -1 / half_.y, 1 / (nearZ - farZ));
  const vec3 offset = vec3(-centre.x / half_.x, centre.y / half_.y, -farZ / (nearZ - farZ));
  const mat4 shadowFromLight = mat4(vec4(scale.x, 0, 0, 0), vec4(0, scale.y, 0, 0), vec4(0, 0, scale.z, 0),
                                    vec4(0, 0, 0, 1));
  mat4 shadowFromWorld = shadowFromLight * frame.lightFromWorld;
  for (int column = 0; column < 4; ++column) shadowFromWorld[column].xyz += offset * frame.lightFromWorld[column].w;

  plan.viewCount = 1;
  plan.views[0].shadowFromWorld = shadowFromWorld;
  plan.views[0].worldFromShadow = inverse(shadowFromWorld);
  plan.views[0].rectOffset = uvec2(0);
  plan.views[0].rectSize = frame.storeSize;
  plan.views[0].texelSize = 2 * half_.xy / size;
  plan.views[0].nearDistance = frame.lightKind == kLightSpot ? 1 / nearZ : -nearZ;
  plan.views[0].farDistance = frame.lightKind == kLightSpot ? 1 / max(farZ, 1e-30) : -farZ;
  plan.views[0].sampleCount = 0;
  plan.views[0].importance = 0;
  plan.views[0].empty = empty ? 1 : 0;
  plan.views[0].padding = 0;
}
