#version 460
#extension GL_GOOGLE_include_directive : require
// partition=cube: a shadow view for each face of a cube about the light, as large as what the face holds of the scene, of
// the samples, or of what the host found. Wider by as many texels as a lookup looks at beside its own, so that it never
// sees a face's end.
#include "estimate.glsl"

layout(local_size_x = kCubeFaces) in;

layout(constant_id = 0) const uint kBox = kOnlyScene;

LightBox wholeFace(uint face) { return LightBox(frame.lsFaceMin[face], frame.lsFaceMax[face]); }

LightBox faceBox(uint face) {
  const LightBox all = wholeFace(face);
  if (kBox != kOnlySamples) return all;
  LightBox box = sampleBox(face);
  if (!isEmpty(box)) box.high.z = max(box.high.z, all.high.z);  // as withCasters()
  return box;
}

void planFace(uint face, mat4 lightFromWorld) {
  LightBox box = faceBox(face);
  const float border = 1 + frame.settings.rimTexels;
  const uvec2 texels = texelsFor(face, box, wholeFace(face), 2 * border);
  // At least half of the smallest map is the face's own.
  if (!isEmpty(box)) box = withExtent(withBorder(box, texels, min(border, 0.25 * float(min(texels.x, texels.y)))));
  placeMap(face);
  writeView(face, box, faceFromWorld(face, frame.faceTurn[face], lightFromWorld), texels);
  if (kBox == kOnlySamples || kSizes != kSizesFixed) plan.views[face].sampleCount = analysis.sampleCount[face];
  mapTexels[face] = texels;
}

void main() {
  const uint face = gl_LocalInvocationID.x;
  const mat4 lightFromWorld = kBox == kOnlySamples ? analysis.lightFromWorld : frame.lightFromWorld;
  if (face == 0) writePlan(kCubeFaces, lightFromWorld);
  planFace(face, lightFromWorld);
  barrier();
  shelve(face);
}
