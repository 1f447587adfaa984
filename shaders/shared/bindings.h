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
SUNDIAL_CONST kBindLinear =
    8u;  // uint[]: the bits of depths, or pairs of triangle and depth: maps in a linear buffer
SUNDIAL_CONST kBindRaster = 9u;       // RasterState
SUNDIAL_CONST kBindListed = 10u;      // ListedTriangle[]
SUNDIAL_CONST kBindParts = 11u;       // RasterPart[]
SUNDIAL_CONST kBindBands = 12u;       // RasterBand[]
SUNDIAL_CONST kBindSilhouette = 13u;  // SilhouetteDraw, SilhouetteEdge[]: shadow volumes
SUNDIAL_CONST kBindWarps = 14u;       // float[]: the warp's tables, warp.glsl
SUNDIAL_CONST kBindImportance = 15u;  // uint[]: what they are made from
SUNDIAL_CONST kBindWanted = 16u;      // WantedTexels, uint[]: what lookups of packed triangles read
SUNDIAL_CONST kStorageBindings = 17u;

// Read at random, so through texel buffers: lavapipe gathers a whole texel at once, but a storage buffer's
// words one by one and lane by lane.
SUNDIAL_CONST kBindVertices = 17u;      // RGBA32UI: Vertex
SUNDIAL_CONST kBindAttributes = 18u;    // RGBA32UI: Attributes
SUNDIAL_CONST kBindTriangles = 19u;     // RGBA32UI: Triangle
SUNDIAL_CONST kBindDraws = 20u;         // RG32UI: Draw
SUNDIAL_CONST kBindInstances = 21u;     // RGBA32F: a row of Instance
SUNDIAL_CONST kBindLinearTexels = 22u;  // R32UI or RG32UI: what kBindLinear holds
// Of shadow volumes, of lookups of triangles, and of warps alone:
SUNDIAL_CONST kBindEdges = 23u;         // RGBA32UI: Edge
SUNDIAL_CONST kBindEdgeSides = 24u;     // R32UI: triangles about edges
SUNDIAL_CONST kBindClusterEdges = 25u;  // RG32UI: first and number of the edges of a cluster
SUNDIAL_CONST kBindPlanes = 26u;        // RGBA32F: a triangle's plane, mesh space
SUNDIAL_CONST kBindTables = 27u;        // RG32UI: slopes and patterns, lookup_tables.h
SUNDIAL_CONST kBindWarpTexels = 28u;    // RG32UI: bits of the floats that kBindWarps holds
SUNDIAL_CONST kBindCentreTexels = 29u;  // RG32UI: what is left in kBindImportance: warp.glsl
SUNDIAL_CONST kBindHeld = 30u;          // RGBA32UI: packed triangles, storage=triangle
SUNDIAL_CONST kBindAdjacent = 31u;      // R32UI: three a triangle: adjacentSide() of its edges
SUNDIAL_CONST kTexelBindings = 32u;

SUNDIAL_CONST kBindHeldWritten = 32u;  // the same, as pack_triangles.comp writes it
SUNDIAL_CONST kStorageTexelBindings = 33u;

SUNDIAL_CONST kBindTextures = 33u;      // sampler2DArray: base colour
SUNDIAL_CONST kBindDepth = 34u;         // sampler2D: the G-buffer's depth
SUNDIAL_CONST kBindIds = 35u;           // usampler2D: the G-buffer's draw and triangle
SUNDIAL_CONST kBindPositions = 36u;     // usampler2D: view samples, position's bits and instance
SUNDIAL_CONST kBindNormals = 37u;       // usampler2D: view samples, normal's bits and triangle
SUNDIAL_CONST kBindStore = 38u;         // sampler2D: the shadow maps
SUNDIAL_CONST kBindVisibility = 39u;    // sampler2D: what resolve wrote
SUNDIAL_CONST kBindMultisampled = 40u;  // sampler2DMS: the depths of one view, storage=moments
SUNDIAL_CONST kBindMoments = 41u;       // sampler2DArray: a layer a view
SUNDIAL_CONST kBindBlurred = 42u;       // sampler2DArray: a view half-way through its blur
SUNDIAL_CONST kBindCount = 43u;

SUNDIAL_SHARED_END
#endif
