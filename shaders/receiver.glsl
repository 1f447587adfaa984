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
  vec2 texel;          // position in the view's map, texels
  float depth;         // with bias; greater is nearer to the light
  vec2 depthPerTexel;  // slope of the receiver's plane
};

Receiver receiverIn(uint view, ViewSample s) {
  const ShadowView v = plan.views[view];
  const vec4 clip = v.shadowFromWorld * vec4(s.wsPosition, 1);
  const vec3 shadow = clip.xyz / clip.w;
  Receiver r;
  r.texel = (shadow.xy * 0.5 + 0.5) * vec2(v.rectSize);

  // Planes transform by the inverse transposed; in homogeneous coordinates that holds for a perspective light too.
  const vec4 plane = vec4(s.wsNormal, -dot(s.wsNormal, s.wsPosition)) * v.worldFromShadow;
  // A plane that contains the light's ray has no slope to follow; it isn't lit either.
  r.depthPerTexel = plane.z != 0 ? -plane.xy / plane.z * 2 / vec2(v.rectSize) : vec2(0);

  const vec4 clipToLight = v.shadowFromWorld * vec4(towardsLight(s.wsPosition), 0);
  const float depthPerMetre = (clipToLight.z - shadow.z * clipToLight.w) / clip.w;
  const float texelMetres =
      max(v.texelSize.x, v.texelSize.y) * (frame.lightKind == kLightSpot ? clip.w : 1.0);
  r.depth = shadow.z + depthPerMetre * (frame.biasWorld + frame.biasTexels * texelMetres);
  return r;
}

// The receiver's depth at the centre of a texel.
float depthAt(Receiver r, ivec2 texel) { return r.depth + dot(r.depthPerTexel, vec2(texel) + 0.5 - r.texel); }

#endif
