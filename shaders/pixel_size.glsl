// How large the surface behind a pixel is in light space, across and up: the box around the pixel's four corners, each at
// the depth between its four neighbours [Ferko 2013, section 3.2].
#ifndef SUNDIAL_PIXEL_SIZE_GLSL
#define SUNDIAL_PIXEL_SIZE_GLSL
#include "bindings.glsl"

// The camera's eye, and its rays through the image's corner and a pixel on, before division in light space, where they are
// added up as they are in the world.
struct LightRays {
  vec4 eye;
  vec4 topLeft;
  vec4 perPixelX;
  vec4 perPixelY;
};
LightRays lightRays(mat4 lightFromWorld) {
  return LightRays(lightFromWorld * vec4(frame.wsEye, 1), lightFromWorld * vec4(frame.wsRayTopLeft, 0),
                   lightFromWorld * vec4(frame.wsRayPerPixelX, 0), lightFromWorld * vec4(frame.wsRayPerPixelY, 0));
}

// Light space after division. A pixel at the image's rim, whose outer corners have too few neighbours, counts as the next one
// inside. Nothing that a texel could be too large for where a corner lies beside a spot light.
vec2 pixelSize(ivec2 at, LightRays rays) {
  const float kHuge = 1e30;
  const ivec2 last = ivec2(frame.imageSize) - 1;
  const ivec2 pixel = max(min(at, last - 1), min(ivec2(1), last));
  float around[9];
  for (int i = 0; i < 9; ++i)
    around[i] = texelFetch(gbufferDepth, clamp(pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), last), 0).r;
  vec2 low = vec2(kHuge), high = vec2(-kHuge);
  for (int i = 0; i < 4; ++i) {
    const int x = i & 1, y = i >> 1, first = 3 * y + x;
    const ivec2 corner = pixel + ivec2(x, y);
    // Bilinear: the buffer holds the reciprocal of depth, which is linear in the image on a plane.
    const float reciprocal = around[first] + around[first + 1] + around[first + 3] + around[first + 4];
    const float depth = 4 * frame.nearDistance / reciprocal;
    const vec4 light = rays.eye + depth * (rays.topLeft + float(corner.x) * rays.perPixelX + float(corner.y) * rays.perPixelY);
    if (light.w <= 0) return vec2(kHuge);
    low = min(low, light.xy / light.w);
    high = max(high, light.xy / light.w);
  }
  return high - low;
}

#endif
