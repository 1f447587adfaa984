#version 460
#extension GL_GOOGLE_include_directive : require
// What answered each view sample, for the measures: outside the timed frame.
#include "choose_view.glsl"
#include "stored_depth.glsl"

layout(location = 0) out uvec4 outAnswer;

// Length in pixels of a step on the receiver, seen from the camera.
float pixelsOf(ViewSample s, vec3 wsStep) {
  const vec4 from = frame.clipFromWorld * vec4(s.wsPosition, 1);
  const vec4 step_ = frame.clipFromWorld * vec4(wsStep, 0);
  const vec2 ndcPerStep = (step_.xy - from.xy / from.w * step_.w) / from.w;
  return length(ndcPerStep * 0.5 * vec2(frame.imageSize));
}

// The longer side of the texel's footprint on the receiver's plane, in pixels of the image.
float footprint(uint view, ViewSample s) {
  const ShadowView v = plan.views[view];
  const vec4 clip = v.shadowFromWorld * vec4(s.wsPosition, 1);
  const vec3 shadow = clip.xyz / clip.w;
  // How the map's texels move along two tangents of the plane, and from that how the plane moves along the texels.
  const vec3 axis = abs(s.wsNormal.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0);
  const vec3 wsU = normalize(cross(axis, s.wsNormal)), wsV = cross(s.wsNormal, wsU);
  const vec4 clipU = v.shadowFromWorld * vec4(wsU, 0), clipV = v.shadowFromWorld * vec4(wsV, 0);
  vec2 texelsPerUnit = 0.5 * vec2(v.rectSize) / clip.w;
  if (kWarp != kWarpNone) {
    vec2 stretch;
    warpedPosition(view, 0.5 * (shadow.xy + 1) * vec2(v.rectSize), stretch);
    texelsPerUnit *= stretch;
  }
  const mat2 texelFromPlane = mat2((clipU.xy - shadow.xy * clipU.w) * texelsPerUnit,
                                   (clipV.xy - shadow.xy * clipV.w) * texelsPerUnit);
  if (determinant(texelFromPlane) == 0) return 0;
  const mat2 planeFromTexel = inverse(texelFromPlane);
  return max(pixelsOf(s, mat2x3(wsU, wsV) * planeFromTexel[0]), pixelsOf(s, mat2x3(wsU, wsV) * planeFromTexel[1]));
}

void main() {
  const ViewSample s = sampleAt(ivec2(gl_FragCoord.xy));
  Answer a = Answer(kNoShadowView, 0, 0.0, 0);
  if (facesLight(s)) {
    a.facesLight = 1;
    const Choice c = chooseView(s);
    if (c.view != kNoShadowView) {
      const ivec2 texel = texelIn(c.view, receiverIn(c.view, s).texel);
      a.view = c.view;
      a.texel = indexInStore(c.view, texel);
      a.footprint = footprint(c.view, s);
    }
  }
  outAnswer = uvec4(a.view, a.texel, floatBitsToUint(a.footprint), a.facesLight);
}
