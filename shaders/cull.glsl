// Which clusters a view can see: clusters are culled in chunks of kDrawsPerChunk draws, a chunk a thread, and the
// draws that remain are written in their old order (so that ties in depth, and all counts, repeat exactly).
#ifndef SUNDIAL_CULL_GLSL
#define SUNDIAL_CULL_GLSL
#include "bindings.glsl"

layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
  uint firstSlot;  // slots firstSlot + gl_WorkGroupID.y are culled
};

uint chunkCount() { return frame.drawCount / kDrawsPerChunk; }

#endif
