// How a box of light space becomes a shadow view: what every partition ends with.
#ifndef SUNDIAL_PLAN_VIEW_GLSL
#define SUNDIAL_PLAN_VIEW_GLSL
#include "light.glsl"
#include "ordered.glsl"

// In light space after division.
struct LightBox {
  vec3 low;
  vec3 high;
};

bool isEmpty(LightBox box) { return any(greaterThan(box.low, box.high)); }

LightBox sceneBox() { return LightBox(frame.lsBoundsMin, frame.lsBoundsMax); }

// Of the view samples in a segment of the analysis; empty where there are none.
LightBox sampleBox(uint segment) {
  LightBox box;
  for (uint axis = 0; axis < 3; ++axis) {
    box.low[axis] = floatFromOrdered(analysis.lsMin[3 * segment + axis]);
    box.high[axis] = floatFromOrdered(analysis.lsMax[3 * segment + axis]);
  }
  return analysis.sampleCount[segment] == 0 ? LightBox(vec3(1), vec3(-1)) : box;
}

// As far beyond the box as lookups look.
LightBox withReach(LightBox box) {
  box.low.z = min(box.low.z, frame.settings.lsFar);
  box.low.xy -= frame.settings.lsReach;
  box.high.xy += frame.settings.lsReach;
  return box;
}

// Up to the scene's nearest caster: one before the near plane would be clamped to depth 1, and a receiver that bias or
// its own slope carries there would pass for lit.
LightBox withCasters(LightBox box) {
  box.high.z = max(box.high.z, frame.lsBoundsMax.z);
  return withReach(box);
}

// With texels of border on each side, one so that a sample on the rim has a whole texel.
LightBox withBorder(LightBox box, uvec2 texels, float border) {
  const vec2 size = vec2(texels);
  const vec2 half_ = 0.5 * (box.high.xy - box.low.xy) * size / (size - 2 * border);
  const vec2 centre = 0.5 * (box.low.xy + box.high.xy);
  return LightBox(vec3(centre - half_, box.low.z), vec3(centre + half_, box.high.z));
}

LightBox withBorder(LightBox box, uvec2 texels) { return withBorder(box, texels, 1); }

// Some extent, so that a flat volume has any.
LightBox withExtent(LightBox box) {
  const vec3 centre = 0.5 * (box.low + box.high);
  const vec3 least = vec3(1e-6 * max(max(abs(centre.x), abs(centre.y)), abs(centre.z)) + 1e-30);
  vec3 half_ = max(0.5 * (box.high - box.low), least);
  half_.z *= 1.001;
  return LightBox(centre - half_, centre + half_);
}

// The view of this box, its sides as they are, in a map of this size. What else a view holds is left alone.
void writeView(uint view, LightBox box, mat4 lightFromWorld, uvec2 texels) {
  const bool empty = isEmpty(box);
  if (empty) box = LightBox(vec3(-1), vec3(1));
  if (!lightIsFar()) box.low.z = max(box.low.z, 0);
  const vec3 centre = 0.5 * (box.low + box.high), half_ = 0.5 * (box.high - box.low);
  const float farZ = box.low.z, nearZ = box.high.z;

  // shadow = scale * light + offset * w: image rows run down, depth runs from 0 (far) to 1 (near).
  const vec3 scale = vec3(1 / half_.x, -1 / half_.y, 1 / (nearZ - farZ));
  const vec3 offset = vec3(-centre.x / half_.x, centre.y / half_.y, -farZ / (nearZ - farZ));
  const mat4 shadowFromLight = mat4(vec4(scale.x, 0, 0, 0), vec4(0, scale.y, 0, 0), vec4(0, 0, scale.z, 0),
                                    vec4(0, 0, 0, 1));
  mat4 shadowFromWorld = shadowFromLight * lightFromWorld;
  for (int column = 0; column < 4; ++column) shadowFromWorld[column].xyz += offset * lightFromWorld[column].w;

  plan.views[view].shadowFromWorld = shadowFromWorld;
  plan.views[view].lsMin = box.low;
  plan.views[view].lsMax = box.high;
  plan.views[view].rectSize = texels;
  plan.views[view].texelSize = 2 * half_.xy / vec2(texels);
  plan.views[view].nearDistance = lightIsFar() ? -nearZ : 1 / nearZ;
  plan.views[view].farDistance = lightIsFar() ? -farZ : 1 / max(farZ, 1e-30);
  plan.views[view].empty = empty ? 1 : 0;
}

// What all views of the plan share.
void writePlan(uint viewCount, mat4 lightFromWorld) {
  plan.viewCount = viewCount;
  plan.lightFromWorld = lightFromWorld;
  plan.worldFromLight = inverse(lightFromWorld);
  plan.tilesPerSide = 0;
}

// Where a map of the common size lies in the store, and what it was made for: nothing in particular.
void placeMap(uint view) {
  const uint columns = frame.settings.mapColumns;
  const uvec2 size = frame.settings.mapSize;
  plan.views[view].rectOffset = uvec2(view % columns, view / columns) * size;
  plan.views[view].linearOffset = view * size.x * size.y;
  plan.views[view].sampleCount = 0;
  plan.views[view].importance = 0;
  plan.views[view].depthBegin = 0;
  plan.views[view].depthEnd = 0;
  plan.views[view].tile = 0;
  plan.views[view].padding = 0;
}

#endif
