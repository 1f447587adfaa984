#version 460
#extension GL_GOOGLE_include_directive : require
// warp=rectilinear, forward analysis: how important what the light sees is, a texel of its map an invocation. It knows the
// camera's frustum, but not what the camera sees in it, nor the normals of what it sees itself: those look at the camera.
#include "importance.glsl"

layout(local_size_x = 64) in;

bool inFrustum(vec3 wsPosition) {
  const vec4 clip = frame.clipFromWorld * vec4(wsPosition, 1);
  return clip.w > 0 && all(lessThanEqual(abs(clip.xy), vec2(clip.w)));
}

void main() {
  const uvec2 size = warpSize(), texel = gl_GlobalInvocationID.xy;
  const uint view = gl_WorkGroupID.z;
  if (texel.x >= size.x || plan.views[view].empty != 0) return;
  const float depth = storedDepth(view, ivec2(texel));
  if (depth <= 0) return;
  const vec3 low = plan.views[view].lsMin, high = plan.views[view].lsMax;
  const vec2 share = (vec2(texel) + 0.5) / vec2(size);
  const vec4 ws = plan.worldFromLight * outOfViewSpace(view, vec4(mix(low, high, vec3(share.x, 1 - share.y, depth)), 1));
  const vec3 wsPosition = ws.xyz / ws.w;
  if (!inFrustum(wsPosition)) return;
  vec2 sum = vec2(0);
  if (weightOf(kNearness) > 0) sum += weightOf(kNearness) * nearness(wsPosition);
  if (weightOf(kFacing) > 0) sum += weightOf(kFacing);
  if (weightOf(kDensity) > 0)
    sum += weightOf(kDensity) * density(view, wsPosition, normalize(frame.wsEye - wsPosition));
  if (weightOf(kShadowEdges) > 0 && isShadowEdge(view, ivec2(texel))) sum += weightOf(kShadowEdges);
  makeImportant(view, texel, sum);
}
