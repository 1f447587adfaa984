#version 460
#extension GL_GOOGLE_include_directive : require
// partition=single: one shadow view around the volume.
#include "estimate.glsl"
#include "shared/choices.h"

layout(local_size_x = 1) in;

layout(constant_id = 0) const uint kBox = kOnlyScene;

// focus=calipers: the host knows the nearest caster of this very box.
LightBox hostsBox() {
  LightBox box = LightBox(frame.settings.lsFitMin, frame.settings.lsFitMax);
  return isEmpty(box) ? box : withReach(box);
}

LightBox only() {
  if (kBox == kOnlyHosts) return hostsBox();
  const LightBox box = kBox == kOnlySamples ? sampleBox(0) : sceneBox();
  return isEmpty(box) ? box : withCasters(box);
}

void main() {
  const bool samples = kBox == kOnlySamples;
  LightBox box = only();
  const uvec2 texels = texelsFor(0, box, sceneBox(), 2);
  if (!isEmpty(box)) box = withExtent(withBorder(box, texels));
  const mat4 lightFromWorld = samples ? analysis.lightFromWorld : frame.lightFromWorld;
  writePlan(1, lightFromWorld);
  placeMap(0);
  writeView(0, box, lightFromWorld, texels);
  if (samples || kSizes != kSizesFixed) plan.views[0].sampleCount = analysis.sampleCount[0];
}
