// A view sample in a shadow view, together with the plane that it lies on: what every lookup starts from.
//
// Bias. A texel's depth belongs to its centre, a sample lies elsewhere in the texel, and on a slope the two differ:
// that is acne. The receiver's geometric plane is known, so its depth is compared at the texel's centre, where the
// difference vanishes for flat receivers at any slope. What remains is curvature and corners, where a neighbouring
// face owns the texel's centre, and rounding: for those the receiver moves towards the light by a share of the texel's
// extent and by a length in metres.
#ifndef SUNDIAL_RECEIVER_GLSL
#define SUNDIAL_RECEIVER_GLSL
#include "light.glsl"

struct Receiver {
  vec2 texel;          // position in the store, texels
  float depth;         // with bias; greater is nearer to the light
  vec2 depthPerTexel;  // slope of the receiver's plane
  vec3 wsTexelX;       // what one texel to the right, and down, is on the receiver's plane, metres
  vec3 wsTexelY;
};

Receiver receiverIn(uint view, ViewSample s) {
  const ShadowView v = plan.views[view];
  const mat4 m = v.shadowFromWorld;
  const vec4 clip = m * vec4(s.wsPosition, 1);
  const vec3 shadow = clip.xyz / clip.w;

  // How shadow space moves along two tangents of the receiver's plane, and along the way to the light.
  const vec3 axis = abs(s.wsNormal.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0);
  const vec3 wsU = normalize(cross(axis, s.wsNormal)), wsV = cross(s.wsNormal, wsU);
  const vec3 toLight = towardsLight(s.wsPosition);
  const vec4 clipU = m * vec4(wsU, 0), clipV = m * vec4(wsV, 0), clipL = m * vec4(toLight, 0);
  const vec3 du = (clipU.xyz - shadow * clipU.w) / clip.w;
  const vec3 dv = (clipV.xyz - shadow * clipV.w) / clip.w;
  const float depthPerMetre = (clipL.z - shadow.z * clipL.w) / clip.w;

  const vec2 texelsPerUnit = 0.5 * vec2(v.rectSize);
  const mat2 texelFromPlane = mat2(du.xy * texelsPerUnit, dv.xy * texelsPerUnit);
  const float det = determinant(texelFromPlane);
  Receiver r;
  r.texel = vec2(v.rectOffset) + (shadow.xy * 0.5 + 0.5) * vec2(v.rectSize);
  // A plane that contains the light's ray has no slope to follow; it isn't lit either.
  const mat2 planeFromTexel = abs(det) > 1e-20 ? inverse(texelFromPlane) : mat2(0);
  r.depthPerTexel = vec2(du.z, dv.z) * planeFromTexel;
  r.wsTexelX = wsU * planeFromTexel[0].x + wsV * planeFromTexel[0].y;
  r.wsTexelY = wsU * planeFromTexel[1].x + wsV * planeFromTexel[1].y;

  const float texelMetres =
      max(v.texelSize.x, v.texelSize.y) * (frame.lightKind == kLightSpot ? clip.w : 1.0);
  r.depth = shadow.z + depthPerMetre * (frame.biasWorld + frame.biasTexels * texelMetres);
  return r;
}

// The receiver's depth at the centre of a texel.
float depthAt(Receiver r, ivec2 texel) { return r.depth + dot(r.depthPerTexel, vec2(texel) + 0.5 - r.texel); }

bool inside(uint view, vec2 texel) {
  const vec2 low = vec2(plan.views[view].rectOffset), high = low + vec2(plan.views[view].rectSize);
  return all(greaterThanEqual(texel, low)) && all(lessThan(texel, high));
}

// 1 if nothing in this texel is nearer to the light than the receiver.
float litBy(Receiver r, ivec2 texel) { return depthAt(r, texel) >= texelFetch(store, texel, 0).r ? 1.0 : 0.0; }

// Which shadow view answers a sample, or kNoShadowView where none does and the sample counts as lit.
uint chooseView(ViewSample s) {
  for (uint view = 0; view < plan.viewCount; ++view) {
    if (plan.views[view].empty != 0) continue;
    const vec4 clip = plan.views[view].shadowFromWorld * vec4(s.wsPosition, 1);
    if (clip.w > 0 && all(lessThan(abs(clip.xy), vec2(clip.w)))) return view;
  }
  return kNoShadowView;
}

#endif
