// Which segment of the analysis a view sample belongs to, and the camera's rays in its light space.
#ifndef SUNDIAL_SAMPLE_SEGMENT_GLSL
#define SUNDIAL_SAMPLE_SEGMENT_GLSL
#include "pixel_size.glsl"
#include "segments.glsl"
#include "tiles.glsl"

layout(constant_id = 0) const uint kSegments = kSegmentAll;

// False where no segment has the sample.
bool segmentOf(ViewSample s, vec4 light, out uint segment) {
  segment = 0;
  if (kSegments == kSegmentTile) {
    const Square square = inscribedSquare();
    return tileAt(light.xy / light.w, square.corner, square.side / float(frame.settings.tilesPerSide), frame.settings.tilesPerSide,
                  segment);
  }
  if (kSegments == kSegmentFace) segment = faceOf(light);
  else if (kSegments != kSegmentAll) segment = partitionOf(viewDepth(s.wsPosition, kSegments == kSegmentRadius));
  return true;
}

LightRays raysOf(uint segment) {
  return lightRays(kSegments == kSegmentFace ? faceFromWorld(segment, frame.faceTurn[segment], frame.lightFromWorld)
                                             : frame.lightFromWorld);
}

#endif
