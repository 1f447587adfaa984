// What of a map a pixel covers, and the moments there.
//
// By hand, not by textureGrad: with lavapipe's anisotropic sampler many more pixels were wrong, and answers must not depend on
// neighbours (they may lie on other surfaces, or be strangers). And a footprint that is longer than `anisotropy` allows
// is shortened instead of taken from a coarser level, which would blur it both ways: seen edge-on, a groove's wall would
// have half the map for its footprint.
#ifndef SUNDIAL_FOOTPRINT_GLSL
#define SUNDIAL_FOOTPRINT_GLSL
#include "bindings.glsl"
#include "view_depth.glsl"
#include "view_space.glsl"

// An ellipse in the map, texels.
struct Footprint {
  vec2 longAxis;  // its longer diameter, at most `anisotropy` times the shorter
  float width;    // the shorter one, at least a texel
};

// Where steps to the next pixel across and down lead on the receiver's own plane, texels of the map.
mat2 texelsFromPixels(uint view, ViewSample s) {
  const vec2 lsSize = plan.views[view].lsMax.xy - plan.views[view].lsMin.xy;
  const float depth = max(viewDepth(s.wsPosition, false), frame.nearDistance);
  const vec3 ray = (s.wsPosition - frame.wsEye) / depth;
  const float facing = dot(s.wsNormal, ray);
  const float away = abs(facing) > 1e-6 ? facing : -1e-6;
  const vec3 steps[2] = {frame.wsRayPerPixelX, frame.wsRayPerPixelY};
  const vec4 light = pointInView(view, s.wsPosition);
  mat2 m;
  for (int i = 0; i < 2; ++i) {
    const vec3 wsStep = depth * (steps[i] - dot(s.wsNormal, steps[i]) / away * ray);
    const vec4 lightStep = directionInView(view, wsStep);
    const vec2 lsStep = (lightStep.xy - light.xy / light.w * lightStep.w) / light.w;
    m[i] = clamp(lsStep / lsSize, -1, 1) * vec2(plan.views[view].rectSize) * vec2(1, -1);  // rows run down
  }
  return m;
}

// How far a filter may look from a position in the map to each side, texels: as far as there is a map that is blurred
// like its middle. One that looked farther on one side than on the other would find a slope's mean beside the slope.
vec2 roomAround(uint view, vec2 position) {
  const vec2 size = vec2(plan.views[view].rectSize);
  return min(position, size - position) - 0.5 * frame.moments.lsBlur / plan.views[view].texelSize - 0.5;
}

// Of a pixel as wide as it is far from the next.
Footprint footprintOf(uint view, ViewSample s, vec2 position) {
  const mat2 j = texelsFromPixels(view, s);
  const mat2 m = j * transpose(j);  // whose eigenvalues are the squares of the diameters
  const float middle = 0.5 * (m[0][0] + m[1][1]), half_ = 0.5 * (m[0][0] - m[1][1]);
  const float spread = length(vec2(half_, m[0][1]));
  // Of two formulas for the longer one's direction that whose terms don't cancel.
  const vec2 along = half_ > 0 ? vec2(spread + half_, m[0][1]) : vec2(m[0][1], spread - half_);
  const float length_ = length(along);
  Footprint f;
  const vec2 room = roomAround(view, position);
  f.width = max(min(sqrt(max(middle - spread, 0)), min(room.x, room.y)), 1);
  const float extent = min(sqrt(middle + spread), frame.moments.anisotropy * f.width);
  f.longAxis = length_ > 0 ? extent / length_ * along : vec2(0);
  const vec2 share = 2 * max(room - f.width, 0) / max(abs(f.longAxis), 1e-6);
  f.longAxis *= min(min(share.x, share.y), 1);
  return f;
}

// Their mean over a footprint about a position in the view's map, texels.
vec4 momentsIn(uint view, vec2 position, Footprint f) {
  const int taps = max(int(ceil(length(f.longAxis) / f.width)), 1);
  const int levels = textureQueryLevels(moments);
  const float lod = min(log2(f.width), float(levels - 1));
  vec4 sum = vec4(0);
  // Every level in turn, so that all pixels ask for the same one at a time.
  for (int level = 0; level < levels; ++level) {
    const float weight = 1 - abs(lod - float(level));
    if (weight <= 0) continue;
    for (int tap = 0; tap < taps; ++tap) {
      const vec2 at = position + ((float(tap) + 0.5) / float(taps) - 0.5) * f.longAxis;
      sum += weight / float(taps) * textureLod(moments, vec3(at / vec2(plan.views[view].rectSize), view), float(level));
    }
  }
  return sum;
}

#endif
