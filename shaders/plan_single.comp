#version 460
#extension GL_GOOGLE_include_directive : require
// partition=single: one shadow view around the volume.
#include "estimate.glsl"

layout(local_size_x = 1) in;

layout(constant_id = 0) const uint kFromSamples = 0;  // 1: volume=samples, 0: the whole scene

void main() {
  const bool samples = kFromSamples == 1;
  LightBox box = samples ? sampleBox(0) : sceneBox();
  if (!isEmpty(box)) box = withCasters(box);
  const uvec2 texels = texelsFor(0, box, 2);
  if (!isEmpty(box)) box = withExtent(withBorder(box, texels));
  const mat4 lightFromWorld = samples ? analysis.lightFromWorld : frame.lightFromWorld;
  writePlan(1, lightFromWorld);
  placeMap(0);
  writeView(0, box, lightFromWorld, texels);
  if (samples || kSizes != kSizesFixed) plan.views[0].sampleCount = analysis.sampleCount[0];
}
