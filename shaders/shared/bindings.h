// What is bound where, for every shader and for the host. GLSL declarations: ../bindings.glsl.
#ifndef SUNDIAL_SHARED_BINDINGS_H
#define SUNDIAL_SHARED_BINDINGS_H
#include "interop.h"

SUNDIAL_SHARED_BEGIN

SUNDIAL_CONST kBindFrame = 0u;       // uniform: FrameConstants
SUNDIAL_CONST kBindVertices = 1u;    // Vertex[]
SUNDIAL_CONST kBindAttributes = 2u;  // Attributes[]
SUNDIAL_CONST kBindIndices = 3u;     // uint[]
SUNDIAL_CONST kBindClusters = 4u;    // Cluster[]
SUNDIAL_CONST kBindDraws = 5u;       // Draw[]
SUNDIAL_CONST kBindInstances = 6u;   // Instance[]
SUNDIAL_CONST kBindMaterials = 7u;   // Material[]
SUNDIAL_CONST kBindAnalysis = 8u;    // Analysis
SUNDIAL_CONST kBindPlan = 9u;        // Plan
SUNDIAL_CONST kBindCommands = 10u;   // DrawCommand[]
SUNDIAL_CONST kBindVisible = 11u;    // uvec2[]: a bit a draw, by cull slot and chunk
SUNDIAL_CONST kBindCounts = 12u;     // uint[]: commands, by cull slot and bucket
SUNDIAL_CONST kStorageBindings = 13u;

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
