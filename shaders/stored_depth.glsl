// What a texel of a depth map holds, in an image or in a linear buffer.
#ifndef SUNDIAL_STORED_DEPTH_GLSL
#define SUNDIAL_STORED_DEPTH_GLSL
#include "receiver.glsl"
#include "shared/choices.h"

layout(constant_id = 0) const uint kStore = kStoreImage;

// In the view's map.
ivec2 texelIn(uint view, vec2 position) {
  return clamp(ivec2(floor(position)), ivec2(0), ivec2(plan.views[view].rectSize) - 1);
}

// Of the texel among all of the store's.
uint indexInStore(uint view, ivec2 texel) {
  if (kStore != kStoreImage)
    return plan.views[view].linearOffset + uint(texel.y) * plan.views[view].rectSize.x + uint(texel.x);
  const uvec2 at = plan.views[view].rectOffset + uvec2(texel);
  return at.y * frame.storeSize.x + at.x;
}

float storedDepth(uint view, ivec2 texel) {
  if (kStore == kStoreDepths) return uintBitsToFloat(linearStore[indexInStore(view, texel)]);
  if (kStore == kStoreIds || kStore == kStoreTriangles) return uintBitsToFloat(linearStore[2 * indexInStore(view, texel) + 1]);
  return texelFetch(store, ivec2(plan.views[view].rectOffset) + texel, 0).r;
}

// 1 if nothing in this texel is nearer to the light than the receiver. A receiver that ends within the texel may have
// its plane reach past the far plane there: nothing that a map holds is farther.
float litBy(uint view, Receiver r, ivec2 texel) {
  return max(depthAt(view, r, texel), 0) >= storedDepth(view, texel) ? 1.0 : 0.0;
}

#endif
