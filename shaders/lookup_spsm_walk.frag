#version 460
#extension GL_GOOGLE_include_directive : require
// lookup=spsm, recovery=walk: sub-pixel shadow maps [Lecocq et al. 2014] in which samples that no stored triangle decides
// are decided by the mesh. The paper rebuilds the shadow's edge from the outlines of the nine triangles about the sample;
// where triangles are smaller than texels the true occluder is mostly none of them, but a neighbour of one. So each of
// them that is before the receiver begins a walk over its mesh to the sample (surface_walk.glsl). A sample that none arrives
// over is in a gap of what is nearest to the light: lit, unless it is so far from all light that a surface that no texel
// holds, under that one, is likelier than a ray through both. Beyond the map it needs what lies across each triangle's
// edges, 12 bytes a triangle of the scene, and with packed triangles the ids that they were packed from.
//
// As in the paper a texel decides alone what lies on its triangle, or under it, if rounding leaves no doubt about it and
// light doesn't graze it: lookup_spsm_first.frag.
#include "resolve.glsl"
#include "surface_walk.glsl"
#include "texel_triangle.glsl"

layout(constant_id = 4) const uint kAnswer = kAnswerVisibility;

// Texels to each side of the sample's own in which deep shadow has no light. Fewer fuse gaps of leaves and grids, more leave
// specks of light in shadows: README.md.
const int kDeep = 5;

float answer(uint kind, float lit) { return kAnswer == kAnswerVisibility ? lit : float(kind); }

// The next walk, of those that begin in the kernel's texels from number `k` on, that arrives between the sample and the
// light; `hit` is where.
bool nextOccluder(uint view, ViewSample s, ivec2 centre, inout uint k, out StoredTriangle hit) {
  const uint side = frame.pcfKernel;
  const ivec2 high = ivec2(plan.views[view].rectSize) - 1;
  uint last = kNoInstance;
  while (k < side * side) {
    const ivec2 texel = centre + ivec2(k % side, k / side) - int(side / 2);
    ++k;
    if (any(lessThan(texel, ivec2(0))) || any(greaterThan(texel, high))) continue;
    hit = storedTriangle(view, texel);
    if (!hit.exists || hit.triangle == last) continue;
    last = hit.triangle;
    if (findOccluder(s, hit.instance, hit.triangle) && (hit.triangle != s.triangle || hit.instance != s.instance))
      return true;
  }
  return false;
}

// Whether the texel holds something nearer to the light than the receiver's plane is anywhere in it: what it keeps is the
// nearest depth in all of its square.
bool holdsNearer(uint view, Receiver r, ivec2 texel) {
  const float nearest = depthAt(view, r, texel) + 0.5 * (abs(r.depthPerTexel.x) + abs(r.depthPerTexel.y));
  return max(nearest, 0) < storedDepth(view, texel);
}

bool isDeepInShadow(uint view, Receiver r, ivec2 centre) {
  const ivec2 high = ivec2(plan.views[view].rectSize) - 1;
  for (int y = -kDeep; y <= kDeep; ++y)
    for (int x = -kDeep; x <= kDeep; ++x)
      if (!holdsNearer(view, r, clamp(centre + ivec2(x, y), ivec2(0), high))) return false;
  return true;
}

float lookup(uint view, Receiver r) {
  const ivec2 centre = texelIn(view, r.texel);
  const float byOwn = litByOwn(view, centre, heldIn(view, centre), r, r.texel - (vec2(centre) + 0.5));
  if (byOwn != kUndecided) return answer(kAnswerOneTriangle, byOwn);
  uint k = 0;
  StoredTriangle hit;
  const ViewSample s = onItsPlane(r.viewSample);
  while (nextOccluder(view, s, centre, k, hit))
    if (!isHoleOver(s, hit.instance, hit.triangle)) return answer(kAnswerUncertain, 0);
  return answer(kAnswerUncertain, isDeepInShadow(view, r, centre) ? 0.0 : 1.0);
}
