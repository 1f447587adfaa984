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
#include "view_space.glsl"
#include "warp.glsl"

struct Receiver {
  ViewSample viewSample;
  vec2 texel;          // position in the view's map, texels
  vec2 unwarped;       // the same before the warp, where the plane is a plane
  float depth;         // with bias; greater is nearer to the light
  float exactDepth;    // moved by bias_world alone: for what is exact where the sample is
  float worldBias;     // bias_world, as a difference of depth
  vec2 depthPerTexel;  // slope of the receiver's plane
};

// Shadow space is light space scaled and moved, so a few numbers a view are all that differs from view to view.
Receiver receiverIn(uint view, ViewSample s) {
  const vec3 lsMin = plan.views[view].lsMin, lsMax = plan.views[view].lsMax;
  const vec2 rect = vec2(plan.views[view].rectSize);
  const vec2 texelsPerLight = rect / (lsMax.xy - lsMin.xy) * vec2(1, -1);  // rows run down
  const float depthPerLight = 1 / (lsMax.z - lsMin.z);

  const vec4 light = pointInView(view, s.wsPosition);
  const vec3 ls = light.xyz / light.w;
  Receiver r;
  r.viewSample = s;
  r.unwarped = (ls.xy - vec2(lsMin.x, lsMax.y)) * texelsPerLight;
  vec2 stretch = vec2(1);
  r.texel = kWarp == kWarpNone ? r.unwarped : warpedPosition(view, r.unwarped, stretch);

  const vec4 plane = planeInView(view, s.wsNormal, s.wsPosition);
  // A plane that contains the light's ray has no slope to follow; it isn't lit either.
  r.depthPerTexel = plane.z != 0 ? -plane.xy / plane.z / texelsPerLight * depthPerLight : vec2(0);

  const vec3 toLight = towardsLight(s.wsPosition);
  const vec4 towards = directionInView(view, toLight);
  const float depthPerMetre = (towards.z - ls.z * towards.w) / light.w * depthPerLight;
  const vec2 texelSize = plan.views[view].texelSize / stretch;
  const float texelMetres = (kWarp == kWarpNone ? max(texelSize.x, texelSize.y) : sqrt(texelSize.x * texelSize.y)) * (lightIsFar() ? 1.0 : light.w);
  // A face that looks into the light meets its neighbours' texels with half of the error of one at 45 degrees.
  const float cosine = dot(s.wsNormal, toLight), sine = sqrt(max(1 - cosine * cosine, 0));
  const float biasTexels = frame.biasTexels * (0.5 + 0.5 * min(sine / cosine, 1));
  r.worldBias = depthPerMetre * frame.biasWorld;
  r.exactDepth = (ls.z - lsMin.z) * depthPerLight + r.worldBias;
  r.depth = r.exactDepth + depthPerMetre * biasTexels * texelMetres;
  return r;
}

// The receiver's depth at the centre of a texel.
float depthAt(uint view, Receiver r, ivec2 texel) {
  const vec2 centre = kWarp == kWarpNone ? vec2(texel) + 0.5 : centreOrigin(view, uvec2(texel));
  return r.depth + dot(r.depthPerTexel, centre - r.unwarped);
}

#endif
