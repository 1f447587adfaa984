// What is bound where (shared/bindings.h), declared once.
#ifndef SUNDIAL_BINDINGS_GLSL
#define SUNDIAL_BINDINGS_GLSL

#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/plan.h"
#include "shared/scene.h"

layout(set = 0, binding = kBindFrame, scalar) uniform FrameBlock { FrameConstants frame; };
layout(set = 0, binding = kBindClusters, scalar) readonly buffer ClusterBlock { Cluster clusters[]; };
layout(set = 0, binding = kBindMaterials, scalar) readonly buffer MaterialBlock { Material materials[]; };
layout(set = 0, binding = kBindAnalysis, scalar) buffer AnalysisBlock { Analysis analysis; };
layout(set = 0, binding = kBindPlan, scalar) buffer PlanBlock { Plan plan; };
layout(set = 0, binding = kBindCommands, scalar) buffer CommandBlock { DrawCommand commands[]; };
layout(set = 0, binding = kBindVisible, scalar) buffer VisibleBlock { uvec2 visible[]; };
layout(set = 0, binding = kBindCounts, scalar) buffer CountBlock { uint counts[]; };
layout(set = 0, binding = kBindLinear, scalar) buffer LinearBlock { uint linearStore[]; };
layout(set = 0, binding = kBindWarps, scalar) buffer WarpBlock { vec2 warps[]; };
layout(set = 0, binding = kBindImportance, scalar) buffer ImportanceBlock { uint importance[]; };
layout(set = 0, binding = kBindVertices) uniform usamplerBuffer vertexTexels;
layout(set = 0, binding = kBindAttributes) uniform usamplerBuffer attributeTexels;
layout(set = 0, binding = kBindTriangles) uniform usamplerBuffer triangleTexels;
layout(set = 0, binding = kBindDraws) uniform usamplerBuffer drawTexels;
layout(set = 0, binding = kBindInstances) uniform samplerBuffer instanceTexels;
layout(set = 0, binding = kBindEdges) uniform usamplerBuffer edgeTexels;
layout(set = 0, binding = kBindEdgeSides) uniform usamplerBuffer edgeSideTexels;
layout(set = 0, binding = kBindClusterEdges) uniform usamplerBuffer clusterEdgeTexels;
layout(set = 0, binding = kBindPlanes) uniform samplerBuffer planeTexels;
layout(set = 0, binding = kBindLinearTexels) uniform usamplerBuffer linearTexels;
layout(set = 0, binding = kBindTables) uniform usamplerBuffer tableTexels;
layout(set = 0, binding = kBindWarpTexels) uniform usamplerBuffer warpTexels;
layout(set = 0, binding = kBindCentreTexels) uniform usamplerBuffer centreTexels;
layout(set = 0, binding = kBindHeld) uniform usamplerBuffer heldTriangles;
layout(set = 0, binding = kBindAdjacent) uniform usamplerBuffer adjacentTexels;
layout(set = 0, binding = kBindTextures) uniform sampler2DArray textures;
layout(set = 0, binding = kBindDepth) uniform sampler2D gbufferDepth;
layout(set = 0, binding = kBindIds) uniform usampler2D gbufferIds;
layout(set = 0, binding = kBindPositions) uniform usampler2D samplePositions;
layout(set = 0, binding = kBindNormals) uniform usampler2D sampleNormals;
layout(set = 0, binding = kBindStore) uniform sampler2D store;
layout(set = 0, binding = kBindVisibility) uniform sampler2D visibility;
layout(set = 0, binding = kBindMultisampled) uniform sampler2DMS multisampled;
layout(set = 0, binding = kBindMoments) uniform sampler2DArray moments;
layout(set = 0, binding = kBindBlurred) uniform sampler2DArray blurredAcross;

vec3 vertexPosition(uint vertex) { return uintBitsToFloat(texelFetch(vertexTexels, int(vertex)).xyz); }

Attributes vertexAttributes(uint vertex) {
  const uvec4 texel = texelFetch(attributeTexels, int(vertex));
  return Attributes(uintBitsToFloat(texel.xy), texel.z, 0);
}

Triangle triangleAt(uint triangle) {
  const uvec4 texel = texelFetch(triangleTexels, int(triangle));
  return Triangle(uint[3](texel.x, texel.y, texel.z), texel.w);
}

Draw drawAt(uint draw) {
  const uvec2 texel = texelFetch(drawTexels, int(draw)).xy;
  return Draw(texel.x, texel.y);
}

Instance instanceAt(uint instance) {
  const int first = 3 * int(instance);
  return Instance(vec4[3](texelFetch(instanceTexels, first), texelFetch(instanceTexels, first + 1),
                          texelFetch(instanceTexels, first + 2)));
}

vec3 placed(Instance i, vec3 position) {
  const vec4 p = vec4(position, 1);
  return vec3(dot(i.worldFromMesh[0], p), dot(i.worldFromMesh[1], p), dot(i.worldFromMesh[2], p));
}

ViewSample sampleAt(ivec2 pixel) {
  const uvec4 position = texelFetch(samplePositions, pixel, 0), normal = texelFetch(sampleNormals, pixel, 0);
  return ViewSample(uintBitsToFloat(position.xyz), position.w, uintBitsToFloat(normal.xyz), normal.w);
}

#endif
