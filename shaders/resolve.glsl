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
  const uint view = chooseView(s);
  outVisibility = view == kNoShadowView ? 1.0 : lookup(view, receiverIn(view, s));
}

#endif
