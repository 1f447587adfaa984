#version 460
#extension GL_GOOGLE_include_directive : require
// lookup=evsm: exponential variance shadow maps [Lauritzen and McCool 2008], as [Lauritzen et al. 2011, section 4] uses
// them: the pixel's footprint in the map, filtered by levels and anisotropy, and Chebyshev's upper bound on the share of
// it that lies no nearer to the light than the receiver.
#include "footprint.glsl"
#include "moments.glsl"
#include "resolve.glsl"

// The largest share of a distribution with this mean and mean square that can lie at t or beyond.
float chebyshev(float mean, float meanSquare, float t, float leastDeviation) {
  const float variance = max(meanSquare - mean * mean, leastDeviation * leastDeviation);
  return t <= mean ? 1 : variance / (variance + (t - mean) * (t - mean));
}

// What the negative warp's mean over the receiver's own plane is, in units of its value at the receiver: on a slope the
// filter sees depths to both sides, and the mean of e^(-c z) is more than e^(-c mean z), so that a plane would shadow
// itself. The positive warp's mean lies on the lit side.
float meanOverPlane(uint view, Receiver r, Footprint f) {
  const vec2 blur = frame.moments.lsBlur / plan.views[view].texelSize;
  const vec2 texels = sqrt(blur * blur + f.longAxis * f.longAxis + f.width * f.width);
  const vec2 slope = abs(r.depthPerTexel) * linearPerDepth(view, r.depth);
  const vec2 reach = clamp(0.5 * slope * texels * frame.moments.exponents.y, 1e-2, 20);
  const vec2 mean = sinh(reach) / reach;  // over an interval of such a reach to both sides
  return mean.x * mean.y;
}

float lookup(uint view, Receiver r) {
  const Footprint f = footprintOf(view, r.viewSample, r.texel);
  const vec4 m = momentsIn(view, r.texel, f);
  const vec2 t = warped(view, r.depth) * vec2(1, meanOverPlane(view, r, f));
  // A deviation of depth, carried through the warps' slopes.
  const vec2 least = frame.moments.leastDeviation * linearPerMetre(view) * frame.moments.exponents * abs(t);
  const float lit = min(chebyshev(m.x, m.y, t.x, least.x), chebyshev(m.z, m.w, t.y, least.y));
  // Where several casters overlap, the bound stays above zero: what it says below this is taken for nothing.
  const float reduction = frame.moments.bleedReduction;
  return clamp((lit - reduction) / (1 - reduction), 0, 1);
}
