#version 460
#extension GL_GOOGLE_include_directive : require
// partition along the camera's depth: a view for each, around
//   loose    the part of the view frustum in its range of depth, as far as the scene reaches [Zhang et al. 2006]
//   samples  its view samples (focus=aabb, aligned) [Lauritzen et al. 2011, section 3.3]
//   snapped  the same, with sides of powers of two texel by texel and corners on a grid that is fixed in the world, so
//            that a texel that stays in the map stays where it is [section 5.3]
#include "estimate.glsl"
#include "shared/choices.h"

layout(local_size_x = kMaxPartitions) in;

layout(constant_id = 0) const uint kFit = kFitLoose;

LightBox within(LightBox box, LightBox limit) {
  return LightBox(clamp(box.low, limit.low, limit.high), clamp(box.high, limit.low, limit.high));
}

LightBox sliceBox(float depthBegin, float depthEnd) {
  LightBox box = LightBox(vec3(1e38), vec3(-1e38));
  for (uint corner = 0; corner < 8; ++corner) {
    const vec2 pixel = vec2(corner & 1, corner >> 1 & 1) * vec2(frame.imageSize);
    const vec3 ray = frame.wsRayTopLeft + pixel.x * frame.wsRayPerPixelX + pixel.y * frame.wsRayPerPixelY;
    const vec4 light =
        frame.lightFromWorld * vec4(frame.wsEye + ((corner & 4) == 0 ? depthBegin : depthEnd) * ray, 1);
    // Beside and behind a spot light projections have no bounds.
    if (light.w <= 0) return sceneBox();
    box.low = min(box.low, light.xyz / light.w);
    box.high = max(box.high, light.xyz / light.w);
  }
  return within(box, sceneBox());
}

LightBox snapped(LightBox box, uvec2 texels) {
  for (uint axis = 0; axis < 2; ++axis) {
    // Two texels are lost at the rims.
    const float side = max(box.high[axis] - box.low[axis], 1e-6 * float(kSnapPeriod));
    const float texel = exp2(ceil(log2(side / float(texels[axis] - 2))));
    const float origin = frame.settings.lsOriginOnGrid[axis];
    const float low = floor((0.5 * (box.low[axis] + box.high[axis]) + origin) / texel) -
                      float(texels[axis] / 2);
    box.low[axis] = low * texel - origin;
    box.high[axis] = (low + float(texels[axis])) * texel - origin;
  }
  return box;
}

void planView(uint view, mat4 lightFromWorld) {
  const float depthBegin = analysis.splits[view], depthEnd = analysis.splits[view + 1];
  // The first partition begins at the camera, whatever the formula's near depth is.
  LightBox box = kFit == kFitLoose ? sliceBox(view == 0 ? frame.nearDistance : depthBegin, depthEnd) : sampleBox(view);
  if (!isEmpty(box)) box = withCasters(box);
  const uvec2 texels = texelsFor(view, box, sceneBox(), 2);
  if (!isEmpty(box)) box = kFit == kFitSnapped ? snapped(withExtent(box), texels) : withExtent(withBorder(box, texels));
  placeMap(view);
  writeView(view, box, lightFromWorld, texels);
  plan.views[view].depthBegin = depthBegin;
  plan.views[view].depthEnd = depthEnd;
  if (kFit != kFitLoose || kSizes != kSizesFixed) plan.views[view].sampleCount = analysis.sampleCount[view];
  mapTexels[view] = texels;
}

void main() {
  const uint view = gl_LocalInvocationID.x;
  const bool used = view < frame.settings.partitions;
  const mat4 lightFromWorld = kFit == kFitLoose ? frame.lightFromWorld : analysis.lightFromWorld;
  if (view == 0) writePlan(frame.settings.partitions, lightFromWorld);
  if (used) planView(view, lightFromWorld);
  barrier();
  if (used) shelve(view);
}
