// The resolve pass around a lookup: a shader that includes this defines lookup().
#ifndef SUNDIAL_RESOLVE_GLSL
#define SUNDIAL_RESOLVE_GLSL
#include "receiver.glsl"

layout(location = 0) out float outVisibility;

// How lit the sample is, in [0, 1], by the maps of one view.
float lookup(uint view, Receiver r);

void main() {
  const ViewSample s = sampleAt(ivec2(gl_FragCoord.xy));
  outVisibility = 0;
  if (!facesLight(s)) return;
  for (uint view = 0; view < kPlanViews; ++view) {
    if (!covers(view, s)) continue;
    outVisibility = lookup(view, receiverIn(view, s));
    return;
  }
  outVisibility = 1;
}

#endif
