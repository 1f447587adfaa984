// The resolve pass around a lookup: a shader that includes this defines lookup().
#ifndef SUNDIAL_RESOLVE_GLSL
#define SUNDIAL_RESOLVE_GLSL
#include "choose_view.glsl"
#include "receiver.glsl"

layout(location = 0) out float outVisibility;

// How lit the sample is, in [0, 1], by the map of one view.
float lookup(uint view, Receiver r);

void main() {
  const ViewSample s = sampleAt(ivec2(gl_FragCoord.xy));
  outVisibility = 0;
  if (!facesLight(s)) return;
  outVisibility = 1;
  const Choice c = chooseView(s);
  if (c.view == kNoShadowView) return;
  outVisibility = lookup(c.view, receiverIn(c.view, s));
  if (kBlend && c.nextWeight > 0)
    outVisibility = mix(outVisibility, lookup(c.next, receiverIn(c.next, s)), c.nextWeight);
}

#endif
