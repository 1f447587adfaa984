#version 460
#extension GL_GOOGLE_include_directive : require
// lookup=spsm: sub-pixel shadow maps [Lecocq et al. 2014, sections 4 and 5]. A sample is lit if it lies on the triangle
// that its texel holds, because that is the nearest of all that touch the texel; in shadow if its ray crosses that
// triangle, or one of a neighbouring texel; or else uncertain, and the shadow's edge is rebuilt. Samples that one
// triangle decides don't come here: lookup_spsm_first.frag.
#include "footprint.glsl"
#include "resolve.glsl"
#include "texel_triangle.glsl"

layout(constant_id = 4) const uint kAnswer = kAnswerVisibility;
layout(constant_id = 6) const uint kPositions = 1;  // in a pixel, of those that are uncertain

// How far along the tangent the edge is followed to each side, texels: what is farther away may belong to another edge.
const float kReach = 0.25;
// A sample so far from every occluder that a texel holds, texels, is in a hole: triangles that no texel holds are small.
const float kGap = 0.3;

struct Around {
  ivec2 centre;
  vec2 at;  // the sample, from the centre texel's centre
  Held held[9];
  uint occluders;  // a bit a neighbour, as neighbourAt() counts them; bit 8: the texel itself
};

float answer(uint kind, float lit) { return kAnswer == kAnswerVisibility ? lit : float(kind); }

// Whether the triangle of this texel, where it is nearest to the light, is nearer than the receiver's plane there.
bool occludes(Held held, Receiver r, vec2 fromSample) {
  if (!held.exists || isOnPlane(held, r, -fromSample)) return false;
  const vec2 nearest = nearestPoint(held.t);
  const float receiver = r.depth + dot(r.depthPerTexel, fromSample + nearest);
  return planeDepth(held.t, nearest) > receiver;
}

// The line that the shadow's edge follows at the sample, seen along a tangent, in the tangent's own axes from the
// sample: (way, depth into the shadow).
EdgeFunction edgeOf(Around around, vec2 light) {
  const vec2 tangent = vec2(-light.y, light.x);
  EdgeFunction f = emptyEdge();
  // What the first round found moves in the second, because left and right depend on each other.
  for (int round_ = 0; round_ < 2; ++round_)
    for (uint i = 0; i < 9; ++i) {
      if ((around.occluders >> i & 1u) == 0) continue;
      const vec2 offset = (i < 8 ? neighbourAt(i) : vec2(0)) - around.at;
      const TexelTriangle t = around.held[i].t;
      const float turn = cross2(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]) >= 0 ? 1.0 : -1.0;
      for (int k = 0; k < 3; ++k) {
        const vec2 from = t.corners[k] + offset, to = t.corners[(k + 1) % 3] + offset, along = to - from;
        // Its outer side looks to the light.
        if (turn * cross2(light, along) <= 0) continue;
        const vec2 a = vec2(dot(from, tangent), -dot(from, light)), b = vec2(dot(to, tangent), -dot(to, light));
        const vec2 part = clippedToBox(a, b, vec2(kReach, 1e9));
        if (part.x > part.y) continue;
        f = with(with(f, mix(a, b, part.x)), mix(a, b, part.y));
      }
    }
  return f;
}

// From a place, counted from the sample, to the nearest triangle that a texel holds and that occludes, texels.
float distanceToOccluders(Around around, vec2 place) {
  float least = 1e9;
  for (uint i = 0; i < 9; ++i) {
    if ((around.occluders >> i & 1u) == 0) continue;
    const vec2 offset = (i < 8 ? neighbourAt(i) : vec2(0)) - around.at - place;
    for (int k = 0; k < 3; ++k)
      least = min(least, segmentDistance(around.held[i].t.corners[k] + offset,
                                         around.held[i].t.corners[(k + 1) % 3] + offset));
  }
  return least;
}

// From the pixel's middle. A place on each row and column: as rooks that don't threaten each other.
vec2 placeInPixel(uint i) {
  return (vec2(float(i), float((i * 2 + i * 2 / kPositions) % kPositions)) + 0.5) / float(kPositions) - 0.5;
}

// Share of the positions in the pixel that lie in the shadow of all edges.
float recovered(uint view, Receiver r, Around around) {
  const uint edges = texelFetch(tableTexels, int(kSlopeCodes + (around.occluders & 0xffu))).x;
  const uint count = edges & 7u;
  if (count == 0) return 1;
  const mat2 texelsFromPixel = kPositions > 1 ? texelsFromPixels(view, r.viewSample) : mat2(0);
  uint shadowed = (1u << kPositions) - 1u;
  for (uint e = 0; e < count; ++e) {
    const float turn = float(edges >> (3 + 4 * e) & 15u) * (kHalfPi / 4);
    const vec2 light = vec2(cos(turn), -sin(turn)), tangent = vec2(-light.y, light.x);
    const EdgeFunction f = edgeOf(around, light);
    if (!f.hasLeft || !f.hasRight) return 1;
    for (uint i = 0; i < kPositions; ++i) {
      const vec2 move = texelsFromPixel * placeInPixel(i);
      if (valueAt(f, dot(move, tangent)) >= -dot(move, light)) shadowed &= ~(1u << i);
    }
    if (shadowed == 0) return 1;
  }
  for (uint i = 0; i < kPositions; ++i)
    if (distanceToOccluders(around, texelsFromPixel * placeInPixel(i)) > kGap) shadowed &= ~(1u << i);
  return 1 - float(bitCount(shadowed)) / float(kPositions);
}

float lookup(uint view, Receiver r) {
  Around around;
  around.centre = texelIn(view, r.texel);
  around.at = r.texel - (vec2(around.centre) + 0.5);
  const Held own = heldIn(view, around.centre);
  const float byOwn = litByOwn(view, around.centre, own, r, around.at);
  if (byOwn != kUndecided) return answer(kAnswerOneTriangle, byOwn);

  const ivec2 high = ivec2(plan.views[view].rectSize) - 1;
  around.held[8] = own;
  for (uint i = 0; i < 8; ++i) {
    const ivec2 texel = around.centre + ivec2(neighbourAt(i));
    around.held[i] = noTriangle();
    if (any(lessThan(texel, ivec2(0))) || any(greaterThan(texel, high))) continue;
    around.held[i] = heldIn(view, texel);
    if (hides(around.held[i], r, around.at - neighbourAt(i)))
      return answer(kAnswerNeighbours, 0);
  }
  const int reach = int(frame.pcfKernel) / 2;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      const ivec2 texel = around.centre + ivec2(x, y);
      if (max(abs(x), abs(y)) < 2 || any(lessThan(texel, ivec2(0))) || any(greaterThan(texel, high))) continue;
      if (hides(heldIn(view, texel), r, around.at - vec2(x, y)))
        return answer(kAnswerNeighbours, 0);
    }
  if (kRecovery == kRecoverNothing) return answer(kAnswerNeighbours, 1);

  around.occluders = 0;
  for (uint i = 0; i < 9; ++i)
    if (occludes(around.held[i], r, (i < 8 ? neighbourAt(i) : vec2(0)) - around.at)) around.occluders |= 1u << i;
  // No shadow's edge passes through a texel that no occluder touches.
  if ((around.occluders >> 8 & 1u) == 0) return answer(kAnswerNeighbours, 1);
  if (around.occluders == 0x1ffu) return answer(kAnswerUncertain, 0);
  return answer(kAnswerUncertain, recovered(view, r, around));
}
