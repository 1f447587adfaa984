// Which shadow view answers a view sample.
#ifndef SUNDIAL_CHOOSE_VIEW_GLSL
#define SUNDIAL_CHOOSE_VIEW_GLSL
#include "bindings.glsl"
#include "shared/choices.h"
#include "tiles.glsl"
#include "view_depth.glsl"
#include "view_space.glsl"

layout(constant_id = 1) const uint kChoice = kChooseOnly;
// The plan's most views: a constant, so that a plan of one is read at a constant place, which is cheap everywhere.
layout(constant_id = 2) const uint kPlanViews = 1;
layout(constant_id = 3) const bool kBlend = false;

struct Choice {
  uint view;         // kNoShadowView: none has an answer, the sample counts as lit
  uint next;         // the view that it fades into
  float nextWeight;  // 0 where it doesn't
};

// Whether the view has an answer for a point of light space, at least as far from the map's sides as this.
bool covers(uint view, vec4 light, vec2 lsRim) {
  if (view >= plan.viewCount || plan.views[view].empty != 0) return false;
  const vec2 ls = light.xy / light.w;
  return light.w > 0 && all(greaterThan(ls, plan.views[view].lsMin.xy + lsRim)) &&
         all(lessThan(ls, plan.views[view].lsMax.xy - lsRim));
}

// A tile's rim belongs to it up to rounding.
bool covers(uint view, vec4 light) {
  const vec2 size = plan.views[view].lsMax.xy - plan.views[view].lsMin.xy;
  return covers(view, light, kChoice == kChooseTile ? -1e-5 * size : vec2(0));
}

// With all that a lookup looks at.
bool coversAround(uint view, vec4 light) {
  return covers(view, light, frame.settings.rimTexels * plan.views[view].texelSize + frame.settings.lsReach);
}

// The partition of this camera depth: the last takes what lies behind all, the first what lies before.
uint partitionAt(float depth) {
  uint part = 0;
  for (uint view = 1; view < kPlanViews; ++view)
    part += view < plan.viewCount && depth >= plan.views[view].depthBegin ? 1 : 0;
  return part;
}

// Of those that contain the point, before their far plane, the one with the smallest texels
// [Lauritzen et al. 2011, section 3.3].
uint tightest(vec4 light, uint otherwise) {
  uint best = otherwise;
  float bestArea = 1e38;
  for (uint view = 0; view < kPlanViews; ++view) {
    const float area = plan.views[view].texelSize.x * plan.views[view].texelSize.y;
    const bool better = coversAround(view, light) && light.z >= plan.views[view].lsMin.z * light.w && area < bestArea;
    best = better ? view : best;
    bestArea = better ? area : bestArea;
  }
  return best;
}

Choice chooseView(ViewSample s) {
  Choice c = Choice(0, 0, 0.0);
  const vec4 light = plan.lightFromWorld * vec4(s.wsPosition, 1);
  if (kChoice == kChooseTile) {
    uint tile;
    const bool inside = tileAt(light.xy / light.w, plan.lsSquareMin, plan.lsTileSide, plan.tilesPerSide, tile);
    c.view = inside ? plan.viewOfTile[tile] : kNoShadowView;
  } else if (kChoice == kChooseFace) {
    c.view = faceOf(light);
  } else if (kChoice != kChooseOnly) {
    const float depth = viewDepth(s.wsPosition, kChoice == kChooseRadius);
    c.view = partitionAt(depth);
    if (kBlend && c.view + 1 < plan.viewCount) {
      const float begin = plan.views[c.view].depthBegin, end = plan.views[c.view].depthEnd;
      const float width = frame.settings.blend * (end - begin);
      c.nextWeight = width > 0 ? clamp((depth - (end - width)) / width, 0, 1) : 0.0;
      c.next = c.view + 1;
      if (!covers(c.next, light)) c.nextWeight = 0;
    }
    if (kChoice == kChooseTightest) c.view = tightest(light, c.view);
  }
  if (c.view != kNoShadowView && !covers(c.view, inViewSpace(c.view, light))) c.view = kNoShadowView;
  return c;
}

#endif
