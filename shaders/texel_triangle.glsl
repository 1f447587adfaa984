// The triangle that a texel holds, in units of texels about the texel's centre: unpacked (storage=triangle), or looked
// up by its id with all its corners' precision (storage=depth-id).
#ifndef SUNDIAL_TEXEL_TRIANGLE_GLSL
#define SUNDIAL_TEXEL_TRIANGLE_GLSL
#include "map_triangle.glsl"
#include "shared/silhouette.h"
#include "stored_triangle.glsl"

layout(constant_id = 5) const uint kRecovery = kRecoverNothing;
// Whether a stored triangle decides only what its rounding leaves no doubt about: the rest is asked of the mesh.
const bool kDoubts = kRecovery == kRecoverWalk;
// Whether there are alpha-tested triangles, and walks to ask where their holes are.
layout(constant_id = 9) const bool kHoles = false;

// What single precision makes of a place on a map, in shares of the map.
const float kMapRounding = 1e-6;

struct Held {
  bool exists;
  TexelTriangle t;
  vec2 cornerError;  // at most, of what packing rounded, or else single precision, texels
  float depthError;  // of packing; 0 where nothing was packed
  vec2 slopeError;
  uvec2 owner;  // instance and triangle; kNoInstance where they aren't known
};

Held noTriangle() {
  Held held;
  held.exists = false;
  held.t = TexelTriangle(vec2[3](vec2(0), vec2(0), vec2(0)), 0.0, vec2(0));
  held.cornerError = vec2(0);
  held.depthError = 0;
  held.slopeError = vec2(0);
  held.owner = uvec2(kNoInstance, 0);
  return held;
}

Held unpacked(uint view, ivec2 texel) {
  Held held = noTriangle();
  const uvec4 packed_ = texelFetch(heldTriangles, int(indexInStore(view, texel)));
  held.exists = packed_.w != 0;
  const vec2 size = vec2(plan.views[view].rectSize), centre = vec2(texel) + 0.5;
  for (int i = 0; i < 3; ++i) held.t.corners[i] = cornerOfCode(packed_[i]) * size - centre;
  const vec2 right = uintBitsToFloat(texelFetch(tableTexels, int(packed_.w >> 8 & 0xffu)).xy);
  const vec2 down = uintBitsToFloat(texelFetch(tableTexels, int(packed_.w & 0xffu)).xy);
  const TexelMetric metric = texelMetric(view);
  held.t.depth = depthOfCode(packed_.w >> 16, metric);
  held.cornerError = 0.5 * (1 + 2 * kCornerMargin) / kCornerSteps * size;
  held.depthError = 0.5 / kDepthSteps * depthPerShare(held.t.depth, metric);
  const vec2 slopePerCode = slopePerTangent(held.t.depth, metric) / size;
  held.t.slope = vec2(right.x, down.x) * slopePerCode;
  held.slopeError = vec2(right.y, down.y) * slopePerCode;
  return held;
}

Held lookedUp(uint view, ivec2 texel) {
  Held held = noTriangle();
  const uint index = 2 * indexInStore(view, texel);
  held.exists = linearStore[index + 1] != 0;
  if (!held.exists) return held;
  const vec2 size = vec2(plan.views[view].rectSize), centre = vec2(texel) + 0.5;
  const MapTriangle m = mapTriangle(view, linearStore[index], centre / size, held.owner);
  for (int i = 0; i < 3; ++i) held.t.corners[i] = m.corners[i] * size - centre;
  held.cornerError = kMapRounding * size;
  held.t.depth = m.depth;
  held.t.slope = m.slope / size;
  return held;
}

Held heldIn(uint view, ivec2 texel) {
  return kStore == kStoreTriangles ? unpacked(view, texel) : lookedUp(view, texel);
}

// Whether the receiver, which is at this place, lies on the triangle's plane, or so nearly that packing can't tell: its
// own plane has the stored depth at the texel's centre, and slopes that the stored codes stand for.
bool isOnPlane(Held held, Receiver r, vec2 at) {
  const float surface = r.exactDepth - r.worldBias;
  if (kStore != kStoreTriangles)
    return held.owner == uvec2(r.viewSample.instance, r.viewSample.triangle) ||
           abs(planeDepth(held.t, at) - surface) <= r.worldBias;
  const float atCentre = max(surface - dot(r.depthPerTexel, at), 0);
  if (atCentre > 1) return held.t.depth == kBefore;
  return abs(held.t.depth - atCentre) <= r.worldBias + held.depthError &&
         all(lessThanEqual(abs(held.t.slope - r.depthPerTexel), held.slopeError));
}

// How much nearer to the light than it is packing may have turned the triangle. Where there is nobody else to ask it is
// never counted as more than what a plain map's receiver moves.
float errorAt(Held held, Receiver r, vec2 at) {
  const float most = held.depthError + dot(min(held.slopeError, 1e6), abs(at));
  return kDoubts ? most : min(most, r.depth - r.exactDepth);
}

// Whether it is between the receiver and the light.
bool hides(Held held, Receiver r, vec2 at) {
  return held.exists && planeDepth(held.t, at) - errorAt(held, r, at) > r.exactDepth &&
         containsPoint(held.t.corners, at, kDoubts ? held.cornerError : vec2(0)) && !isOnPlane(held, r, at);
}

// Whether other triangles may be before the sample although its own is the nearest that its texel holds: light grazes it,
// so that the texel has places where it is nearer to the light than the sample, by more than twice what a plain map's
// receiver moves.
bool isGrazed(Receiver r, vec2 at) {
  const float rise = 0.5 * (abs(r.depthPerTexel.x) + abs(r.depthPerTexel.y)) - dot(r.depthPerTexel, at);
  return rise > 2 * (r.depth - r.exactDepth);
}

// What the triangle of the receiver's own texel says alone: how lit it is, or kUndecided. On its plane it is lit, because
// that triangle is the nearest of all that touch the texel, unless there are walks to ask what it says where it is grazed.
const float kUndecided = -1;
float litByOwn(uint view, ivec2 texel, Held own, Receiver r, vec2 at) {
  if (!own.exists) return 1;
  if (isOnPlane(own, r, at)) return kRecovery == kRecoverWalk && isGrazed(r, at) ? kUndecided : 1.0;
  if (!hides(own, r, at)) return kUndecided;
  return kHoles && isMasked(storedTriangle(view, texel)) ? kUndecided : 0.0;
}

#endif
