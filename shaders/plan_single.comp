#version 460
#extension GL_GOOGLE_include_directive : require
// partition=single: one shadow view around the volume.
#include "plan_view.glsl"

layout(local_size_x = 1) in;

layout(constant_id = 0) const uint kFromSamples = 0;  // 1: volume=samples, 0: the whole scene

void main() {
  const bool samples = kFromSamples == 1;
  LightBox box = samples ? sampleBox(0) : sceneBox();
  const uvec2 texels = frame.settings.mapSize;
  if (!isEmpty(box)) box = withExtent(withBorder(withCasters(box), texels));
  const mat4 lightFromWorld = samples ? analysis.lightFromWorld : frame.lightFromWorld;
  writePlan(1, lightFromWorld);
  placeMap(0);
  writeView(0, box, lightFromWorld, texels);
  if (samples) plan.views[0].sampleCount = analysis.sampleCount[0];
}
