// The camera's depth of a view sample, and the partition along it.
#ifndef SUNDIAL_VIEW_DEPTH_GLSL
#define SUNDIAL_VIEW_DEPTH_GLSL
#include "bindings.glsl"

// Metres along the camera's axis; from the eye where kRadial is set, which a turning camera doesn't change.
float viewDepth(vec3 wsPosition, bool radial) {
  if (radial) return distance(wsPosition, frame.wsEye);
  const mat4 m = frame.clipFromWorld;
  return dot(vec4(m[0].w, m[1].w, m[2].w, m[3].w), vec4(wsPosition, 1));
}

#endif
