#version 460
#extension GL_GOOGLE_include_directive : require
// Second half of culling: the draws whose bit is set, compacted within their bucket.
#include "cull.glsl"

uint countOf(uint slot, uint chunk) {
  const uvec2 bits = visible[slot * chunkCount() + chunk];
  return bitCount(bits.x) + bitCount(bits.y);
}

void main() {
  const uint chunk = gl_GlobalInvocationID.x;
  if (chunk >= chunkCount()) return;
  const uint slot = firstSlot + gl_WorkGroupID.y;
  uint bucket = 0;
  while (chunk >= frame.drawBuckets[bucket].x + frame.drawBuckets[bucket].y) ++bucket;
  const uint first = frame.drawBuckets[bucket].x;
  const uint last = first + frame.drawBuckets[bucket].y - 1;

  uint before = 0;
  for (uint c = first; c < chunk; ++c) before += countOf(slot, c);
  uint target = slot * frame.drawCount + first * kDrawsPerChunk + before;
  const uvec2 bits = visible[slot * chunkCount() + chunk];
  for (uint i = 0; i < kDrawsPerChunk; ++i) {
    if ((bits[i / 32] >> (i % 32) & 1u) == 0) continue;
    const uint draw = chunk * kDrawsPerChunk + i;
    const Cluster cluster = clusters[drawAt(draw).cluster];
    commands[target++] = DrawCommand(cluster.indexCount, 1, cluster.firstIndex, 0, draw);
  }
  if (chunk == last) counts[slot * kBuckets + bucket] = before + countOf(slot, chunk);
}
