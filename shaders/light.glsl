// The light as every pass sees it.
#ifndef SUNDIAL_LIGHT_GLSL
#define SUNDIAL_LIGHT_GLSL
#include "bindings.glsl"

// Whether the sample's visible side can be lit at all. server/reference/frame_light.cpp does the same arithmetic, without
// a normalisation that a driver might approximate.
bool facesLight(ViewSample s) {
  if (s.instance == kNoInstance) return false;
  const bool spot = frame.lightKind == kLightSpot;
  const vec3 toLight = spot ? frame.wsLightPosition - s.wsPosition : -frame.wsLightDirection;
  if (!(dot(s.wsNormal, toLight) > 0)) return false;
  return !spot || -dot(toLight, frame.wsLightDirection) >= frame.lightCosCone * sqrt(dot(toLight, toLight));
}

vec3 towardsLight(vec3 wsPosition) {
  return frame.lightKind == kLightDirectional ? -frame.wsLightDirection
                                              : normalize(frame.wsLightPosition - wsPosition);
}

#endif
