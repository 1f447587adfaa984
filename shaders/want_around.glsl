// The texels about a receiver, as some that a lookup will read.
#ifndef SUNDIAL_WANT_AROUND_GLSL
#define SUNDIAL_WANT_AROUND_GLSL
#include "stored_depth.glsl"
#include "wanted.glsl"

// Compilers round positions as they like: another shader may find the receiver a texel further.
const float kPlaceError = 0.01;

void wantAround(uint view, vec2 texel, uint reach) {
  const ivec2 low = texelIn(view, texel - (float(reach) + kPlaceError));
  const ivec2 high = texelIn(view, texel + (float(reach) + kPlaceError));
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) want(indexInStore(view, ivec2(x, y)));
}

#endif
