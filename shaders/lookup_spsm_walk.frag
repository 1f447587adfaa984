#version 460
#extension GL_GOOGLE_include_directive : require
// lookup=spsm, recovery=walk: sub-pixel shadow maps [Lecocq et al. 2014] in which samples that no stored triangle decides
// are decided by the mesh. The paper rebuilds the shadow's edge from the outlines of the nine triangles about the sample;
// where triangles are smaller than texels the true occluder is mostly none of them, but a neighbour of one. So each of
// them that is before the receiver begins a walk over its mesh to the sample (surface_walk.glsl), and a sample that none
// arrives over is lit. Beyond the map it needs what lies across each triangle's edges, 12 bytes a triangle of the scene,
// and with packed triangles the ids that they were packed from.
//
// As in the paper a texel decides alone what lies on its triangle, or under it: lookup_spsm_first.frag. With packed
// triangles only what their rounding leaves no doubt about.
#include "resolve.glsl"
#include "surface_walk.glsl"
#include "texel_triangle.glsl"

layout(constant_id = 4) const uint kAnswer = kAnswerVisibility;

const uint kStartWords = 8;  // a bit for each texel of the largest kernel

// Texels about the sample whose walks are still to be gone: rows of the kernel's square.
struct Starts {
  uint bits[kStartWords];
};

float answer(uint kind, float lit) { return kAnswer == kAnswerVisibility ? lit : float(kind); }

ivec2 offsetOf(uint k) { return ivec2(k % frame.pcfKernel, k / frame.pcfKernel) - int(frame.pcfKernel / 2); }

// The next walk that arrives between the sample and the light; `hit` is where.
bool nextOccluder(uint view, Receiver r, ivec2 centre, inout Starts starts, out StoredTriangle hit) {
  uint last = kNoInstance;
  for (uint word = 0; word < kStartWords; ++word)
    while (starts.bits[word] != 0) {
      const uint k = 32 * word + uint(findLSB(starts.bits[word]));
      starts.bits[word] &= starts.bits[word] - 1;
      hit = storedTriangle(view, centre + offsetOf(k));
      if (hit.triangle == last) continue;
      last = hit.triangle;
      if (findOccluder(r.viewSample, hit.instance, hit.triangle) &&
          (hit.triangle != r.viewSample.triangle || hit.instance != r.viewSample.instance))
        return true;
    }
  return false;
}

float lookup(uint view, Receiver r) {
  const ivec2 centre = texelIn(view, r.texel), high = ivec2(plan.views[view].rectSize) - 1;
  const vec2 at = r.texel - (vec2(centre) + 0.5);
  const Held own = heldIn(view, centre);
  const float byOwn = litByOwn(own, r, at);
  if (byOwn != kUndecided) return answer(kAnswerOneTriangle, byOwn);

  Starts starts;
  for (uint word = 0; word < kStartWords; ++word) starts.bits[word] = 0;
  for (uint k = 0; k < frame.pcfKernel * frame.pcfKernel; ++k) {
    const ivec2 offset = offsetOf(k), texel = centre + offset;
    if (any(lessThan(texel, ivec2(0))) || any(greaterThan(texel, high))) continue;
    const Held held = heldIn(view, texel);
    if (hides(held, r, at - vec2(offset))) return answer(kAnswerNeighbours, 0);
    if (occludes(held, r, r.exactDepth, vec2(offset) - at)) starts.bits[k / 32] |= 1u << k % 32;
  }
  // No shadow's edge passes through a texel that no occluder touches.
  if (!occludes(own, r, r.exactDepth, -at)) return answer(kAnswerNeighbours, 1);
  StoredTriangle hit;
  while (nextOccluder(view, r, centre, starts, hit))
    if (!isHoleOver(r.viewSample, hit.instance, hit.triangle)) return answer(kAnswerUncertain, 0);
  return answer(kAnswerUncertain, 1);
}
