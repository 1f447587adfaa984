// The scene as the GPU reads it. Lengths are metres; positions are in mesh space unless a name says
// otherwise.
#ifndef SUNDIAL_SHARED_SCENE_H
#define SUNDIAL_SHARED_SCENE_H
#include "interop.h"

SUNDIAL_SHARED_BEGIN

SUNDIAL_CONST kMaxClusterTriangles = 128u;
SUNDIAL_CONST kNoTexture = 0xffffffffu;
SUNDIAL_CONST kNoInstance = 0xffffffffu;  // no geometry under the pixel

// The first vertex of each triangle is that triangle's alone and carries its index ("provoking vertex"), so
// that a flat varying names the triangle: gl_PrimitiveID doubles the pass on lavapipe.
struct Vertex {
  vec3 position;
  uint triangle;  // index of the triangle whose first vertex this is; unspecified for the others
};

struct Attributes {
  vec2 uv;      // in the base colour texture, KHR_texture_transform applied
  uint colour;  // vertex colour, RGBA8 unorm, R in the lowest byte
  uint padding;
};

// What a triangle is made of, for passes that start from its index.
struct Triangle {
  uint vertices[3];
  uint material;
};

// What lies across a triangle's edge: a triangle, which of its edges that is, and whether it runs the same
// way in both triangles, as it doesn't where they agree which side is the front.
SUNDIAL_FUNCTION uint adjacentSide(uint triangle, uint edge, bool sameWay) {
  return triangle << 3 | (sameWay ? 4u : 0u) | edge;
}

// At most kMaxClusterTriangles triangles of one material: indices [firstIndex, firstIndex + indexCount).
struct Cluster {
  vec3 boundsMin;
  uint firstIndex;
  vec3 boundsMax;
  uint indexCount;
  uint material;
  uint mesh;
};

// How a texture coordinate outside [0, 1] is read.
SUNDIAL_CONST kWrapRepeat = 0u;
SUNDIAL_CONST kWrapClamp = 1u;
SUNDIAL_CONST kWrapMirror = 2u;

struct Material {
  vec4 baseColour;    // linear RGB and alpha
  float alphaCutoff;  // fragments with alpha below it are not there; 0 for opaque materials
  uint texture;       // layer of the scene's texture array, or kNoTexture
  uint wrapU;
  uint wrapV;
};

// A mesh placed in the world relative to the frame's origin: three rows of an affine matrix.
struct Instance {
  vec4 worldFromMesh[3];
};

// A cluster of an instance, the unit of culling. Draws are sorted by bucket: what a pipeline and a cull mode
// can draw together.
struct Draw {
  uint instance;  // kNoInstance: pads a bucket to a whole chunk
  uint cluster;
};
SUNDIAL_CONST kDrawsPerChunk = 64u;
SUNDIAL_CONST kBuckets = 6u;  // 3 * masked + {cull nothing, cull back faces, cull front faces (mirrored)}
SUNDIAL_CONST kFirstMaskedBucket = 3u;

struct DrawCommand {  // VkDrawIndexedIndirectCommand
  uint indexCount;
  uint instanceCount;
  uint firstIndex;
  int vertexOffset;
  uint firstInstance;  // the draw's index
};

SUNDIAL_SHARED_END
#endif
