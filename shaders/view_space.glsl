// Light space of a view. All views share the plan's, but for those of partition=cube: theirs are turned to their faces.
#ifndef SUNDIAL_VIEW_SPACE_GLSL
#define SUNDIAL_VIEW_SPACE_GLSL
#include "bindings.glsl"

layout(constant_id = 8) const bool kCube = false;

// A point, a direction or a plane, from light space before division.
vec4 inViewSpace(uint view, vec4 light) {
  return kCube ? turnedFace(faceFromLight(view, light), frame.faceTurn[view]) : light;
}

vec4 outOfViewSpace(uint view, vec4 v) {
  return kCube ? lightFromFace(view, turnedFace(v, frame.faceTurn[view] * vec2(1, -1))) : v;
}

// From world space, relative to the frame's origin.
vec4 pointInView(uint view, vec3 ws) { return inViewSpace(view, plan.lightFromWorld * vec4(ws, 1)); }
vec4 directionInView(uint view, vec3 ws) { return inViewSpace(view, plan.lightFromWorld * vec4(ws, 0)); }
// Of points p with dot(normal, p - on) = 0. Planes transform by the inverse transposed; in homogeneous coordinates that
// holds for a perspective light too.
vec4 planeInView(uint view, vec3 wsNormal, vec3 wsOn) {
  return inViewSpace(view, vec4(wsNormal, -dot(wsNormal, wsOn)) * plan.worldFromLight);
}

#endif
