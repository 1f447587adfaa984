// What is bound where, for every shader and for the host. GLSL declarations: ../bindings.glsl.
#ifndef SUNDIAL_SHARED_BINDINGS_H
#define SUNDIAL_SHARED_BINDINGS_H
#include "interop.h"

SUNDIAL_SHARED_BEGIN

SUNDIAL_CONST kBindFrame = 0u;  // uniform: FrameConstants

SUNDIAL_CONST kBindClusters = 1u;   // Cluster[]
SUNDIAL_CONST kBindMaterials = 2u;  // Material[]
SUNDIAL_CONST kBindAnalysis = 3u;   // Analysis
SUNDIAL_CONST kBindPlan = 4u;       // Plan
SUNDIAL_CONST kBindCommands = 5u;   // DrawCommand[]
SUNDIAL_CONST kBindVisible = 6u;    // uvec2[]: a bit a draw, by cull slot and chunk
SUNDIAL_CONST kBindCounts = 7u;     // uint[]: commands, by cull slot and bucket
SUNDIAL_CONST kStorageBindings = 8u;

// Read at random, so through texel buffers: lavapipe gathers a whole texel at once, but a storage buffer's
// words one by one and lane by lane.
SUNDIAL_CONST kBindVertices = 8u;    // RGBA32UI: Vertex
SUNDIAL_CONST kBindAttributes = 9u;  // RGBA32UI: Attributes
SUNDIAL_CONST kBindTriangles = 10u;  // RGBA32UI: Triangle
SUNDIAL_CONST kBindDraws = 11u;      // RG32UI: Draw
SUNDIAL_CONST kBindInstances = 12u;  // RGBA32F: a row of Instance
SUNDIAL_CONST kTexelBindings = 13u;

SUNDIAL_CONST kBindTextures = 13u;    // sampler2DArray: base colour
SUNDIAL_CONST kBindDepth = 14u;       // sampler2D: the G-buffer's depth
SUNDIAL_CONST kBindIds = 15u;         // usampler2D: the G-buffer's draw and triangle
SUNDIAL_CONST kBindPositions = 16u;   // usampler2D: view samples, position's bits and instance
SUNDIAL_CONST kBindNormals = 17u;     // usampler2D: view samples, normal's bits and triangle
SUNDIAL_CONST kBindStore = 18u;       // sampler2D: the shadow maps
SUNDIAL_CONST kBindVisibility = 19u;  // sampler2D: what resolve wrote
SUNDIAL_CONST kBindCount = 20u;

SUNDIAL_SHARED_END
#endif
