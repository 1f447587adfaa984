#version 460
#extension GL_GOOGLE_include_directive : require
// lookup=spsm, the first round: samples that the triangle of their own texel decides, which most are. Their fragments
// have a depth before the second round's, which the depth test then keeps from being shaded; the others fail the test
// here.
#include "choose_view.glsl"
#include "receiver.glsl"
#include "texel_triangle.glsl"
#include "want_around.glsl"

layout(location = 0) out float outVisibility;

float decided(ViewSample s) {
  if (!facesLight(s)) return 0;
  const Choice c = chooseView(s);
  if (c.view == kNoShadowView) return 1;
  const Receiver r = receiverIn(c.view, s);
  const ivec2 texel = texelIn(c.view, r.texel);
  const bool isBetween = kBlend && c.nextWeight > 0;  // two views answer
  const vec2 at = r.texel - (vec2(texel) + 0.5);
  const float lit = isBetween ? kUndecided : litByOwn(c.view, texel, heldIn(c.view, texel), r, at);
  if (kStore == kStoreTriangles && lit == kUndecided && wanted.moreReach > 0) {
    wantAround(c.view, r.texel, wanted.moreReach);
    if (isBetween) wantAround(c.next, receiverIn(c.next, s).texel, wanted.moreReach);
  }
  return lit;
}

void main() {
  const float lit = decided(sampleAt(ivec2(gl_FragCoord.xy)));
  outVisibility = lit;
  gl_FragDepth = lit == kUndecided ? 0.0 : 1.0;
}
