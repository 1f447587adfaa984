#version 460
#extension GL_GOOGLE_include_directive : require
// Near and far of each tile from the bounds of the clusters that reach it, as a renderer does that has no samples yet
// [Alecu 2014, section 3.5, "forward"].
#include "bindings.glsl"
#include "ordered.glsl"
#include "tiles.glsl"

layout(local_size_x = 64) in;

void main() {
  const uint index = gl_GlobalInvocationID.x;
  if (index >= frame.drawCount) return;
  const Draw draw = drawAt(index);
  if (draw.instance == kNoInstance) return;
  const Cluster cluster = clusters[draw.cluster];
  const Instance place = instanceAt(draw.instance);
  vec3 low = vec3(1e38), high = vec3(-1e38);
  for (uint corner = 0; corner < 8; ++corner) {
    const vec3 position = mix(cluster.boundsMin, cluster.boundsMax, vec3(corner & 1, corner >> 1 & 1, corner >> 2));
    const vec4 light = frame.lightFromWorld * vec4(placed(place, position), 1);
    // Beside and behind a spot light projections have no bounds: its cone bounds them.
    if (light.w <= 0) {
      low = frame.lsBoundsMin;
      high = frame.lsBoundsMax;
      break;
    }
    low = min(low, light.xyz / light.w);
    high = max(high, light.xyz / light.w);
  }
  const Square square = inscribedSquare();
  const float side = square.side / float(frame.settings.tilesPerSide);
  const int last = int(frame.settings.tilesPerSide) - 1;
  const ivec2 first = max(ivec2(floor((low.xy - square.corner) / side)), ivec2(0));
  const ivec2 end = min(ivec2(floor((high.xy - square.corner) / side)), ivec2(last));
  for (int y = first.y; y <= end.y; ++y)
    for (int x = first.x; x <= end.x; ++x) {
      const uint tile = uint(y) * frame.settings.tilesPerSide + uint(x);
      atomicMin(analysis.lsMin[3 * tile + 2], orderedFromFloat(low.z));
      atomicMax(analysis.lsMax[3 * tile + 2], orderedFromFloat(high.z));
    }
}
