// The plan: what the stages before storage produce, written on the GPU, read by cull, store and resolve, and
// streamed to clients as the tile layout.
#ifndef SUNDIAL_SHARED_PLAN_H
#define SUNDIAL_SHARED_PLAN_H
#include "interop.h"

SUNDIAL_SHARED_BEGIN

SUNDIAL_CONST kMaxShadowViews = 64u;
SUNDIAL_CONST kNoShadowView = 0xffffffffu;

// One map of the store. Shadow space after the division by w: x and y in [-1, 1] across the rectangle, y down
// as in the image, depth reversed: 1 at the near plane, 0 at the far plane.
struct ShadowView {
  mat4 shadowFromWorld;  // from world space relative to the frame's origin (FrameConstants)
  mat4 worldFromShadow;  // its inverse: carries planes from world to shadow space
  uvec2 rectOffset;      // texels, in the store's image
  uvec2 rectSize;        // texels
  vec2 texelSize;        // directional: metres; spot: metres at one metre from the light
  float
      nearDistance;  // along the light, metres: directional from the light-space origin, spot from the light
  float farDistance;
  uint sampleCount;  // view samples that chose this view; 0 where the partition doesn't count
  uint importance;   // 0 where the resolution isn't ranked
  uint empty;        // 1: nothing to draw
  uint padding;
};

struct Plan {
  uint viewCount;
  uint padding0;
  uint padding1;
  uint padding2;
  ShadowView views[kMaxShadowViews];
};

SUNDIAL_SHARED_END
#endif
