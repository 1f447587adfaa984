// resolution=estimated: the host sets one viewport for all views, and each view's map is a part of it that the device alone
// may know.
#ifndef SUNDIAL_STORE_PLACED_GLSL
#define SUNDIAL_STORE_PLACED_GLSL
#include "bindings.glsl"

layout(push_constant) uniform Push { uint view; };

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[4];  // nothing may be drawn beside the map
};

void placeInStore(vec3 wsPosition) {
  const vec4 shadow = plan.views[view].shadowFromWorld * vec4(wsPosition, 1);
  const vec2 size = vec2(plan.views[view].rectSize), offset = vec2(plan.views[view].rectOffset);
  const vec2 texels = 0.5 * (shadow.xy + shadow.w) * size + shadow.w * offset;
  gl_Position = vec4(2 * texels / vec2(frame.settings.viewport) - shadow.w, shadow.zw);
  gl_ClipDistance[0] = shadow.w + shadow.x;
  gl_ClipDistance[1] = shadow.w - shadow.x;
  gl_ClipDistance[2] = shadow.w + shadow.y;
  gl_ClipDistance[3] = shadow.w - shadow.y;
}

#endif
