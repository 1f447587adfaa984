// The light as every pass sees it.
#ifndef SUNDIAL_LIGHT_GLSL
#define SUNDIAL_LIGHT_GLSL
#include "bindings.glsl"

// Whether the sample's visible side can be lit at all; server/reference says the same in C++.
bool facesLight(ViewSample s) {
  if (frame.lightKind == kLightDirectional) return dot(s.wsNormal, -frame.wsLightDirection) > 0;
  const vec3 toLight = frame.wsLightPosition - s.wsPosition;
  return dot(s.wsNormal, toLight) > 0 && dot(normalize(-toLight), frame.wsLightDirection) >= frame.lightCosCone;
}

vec3 towardsLight(vec3 wsPosition) {
  return frame.lightKind == kLightDirectional ? -frame.wsLightDirection
                                              : normalize(frame.wsLightPosition - wsPosition);
}

#endif
