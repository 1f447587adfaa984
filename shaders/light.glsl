// The light as every pass sees it.
#ifndef SUNDIAL_LIGHT_GLSL
#define SUNDIAL_LIGHT_GLSL
#include "bindings.glsl"

bool lightIsFar() { return frame.lightKind == kLightDirectional; }

// From a point to the light, metres; of a far one a unit vector, without an end.
vec3 wayToLight(vec3 wsPosition) {
  return lightIsFar() ? -frame.wsLightDirection : frame.wsLightPosition - wsPosition;
}

// Whether the sample's visible side can be lit at all. server/reference/frame_light.cpp does the same arithmetic, without
// a normalisation that a driver might approximate.
bool facesLight(ViewSample s) {
  if (s.instance == kNoInstance) return false;
  const vec3 toLight = wayToLight(s.wsPosition);
  if (!(dot(s.wsNormal, toLight) > 0)) return false;
  return frame.lightKind != kLightSpot || -dot(toLight, frame.wsLightDirection) >= frame.lightCosCone * sqrt(dot(toLight, toLight));
}

vec3 towardsLight(vec3 wsPosition) {
  return lightIsFar() ? -frame.wsLightDirection : normalize(wayToLight(wsPosition));
}

#endif
