#version 460
#extension GL_GOOGLE_include_directive : require
// What answered each view sample, for the measures: outside the timed frame.
#include "receiver.glsl"

layout(location = 0) out uvec4 outAnswer;

// Length in pixels of a step on the receiver, seen from the camera.
float pixelsOf(ViewSample s, vec3 wsStep) {
  const vec4 from = frame.clipFromWorld * vec4(s.wsPosition, 1);
  const vec4 step_ = frame.clipFromWorld * vec4(wsStep, 0);
  const vec2 ndcPerStep = (step_.xy - from.xy / from.w * step_.w) / from.w;
  return length(ndcPerStep * 0.5 * vec2(frame.imageSize));
}

void main() {
  const ViewSample s = sampleAt(ivec2(gl_FragCoord.xy));
  Answer a = Answer(kNoShadowView, 0, 0.0, 0);
  if (facesLight(s)) {
    a.facesLight = 1;
    a.view = chooseView(s);
    if (a.view != kNoShadowView) {
      const Receiver r = receiverIn(a.view, s);
      const uvec2 texel = uvec2(floor(r.texel));
      a.texel = texel.y * frame.storeSize.x + texel.x;
      a.footprint = max(pixelsOf(s, r.wsTexelX), pixelsOf(s, r.wsTexelY));
    }
  }
  outAnswer = uvec4(a.view, a.texel, floatBitsToUint(a.footprint), a.facesLight);
}
