// A scene, ready to draw and to trace: what remains of a file when only geometry, alpha and base colour
// count. Immutable once built (scene_builder.h); no Vulkan here.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/view.h"
#include "shared/scene.h"

namespace sundial {

// Clusters [firstCluster, +clusterCount) and triangles [firstTriangle, +triangleCount): both are contiguous
// per mesh, and a mesh's triangles are stored cluster by cluster.
struct Mesh {
  std::string name;
  std::uint32_t firstCluster = 0, clusterCount = 0;
  std::uint32_t firstTriangle = 0, triangleCount = 0;
  glm::vec3 boundsMin{0}, boundsMax{0};
};

// A mesh placed in the world. In double precision: 100 km from the origin a float is 8 mm coarse.
struct Instance {
  glm::dmat4 worldFromMesh{1};  // affine
  std::uint32_t mesh = 0;
  std::string name;
};

struct MaterialInfo {
  std::string name;
  shared::Material gpu;  // as shaders read it
  bool masked = false;   // alpha-tested: alpha below gpu.alphaCutoff is a hole
  bool doubleSided = false;
};

struct Bounds {
  glm::dvec3 min{0}, max{0};
  glm::dvec3 centre() const { return (min + max) * 0.5; }
  double diagonal() const { return glm::length(max - min); }
};

struct Scene {
  std::string name;

  std::vector<shared::Vertex> vertices;
  std::vector<shared::Attributes> attributes;  // one a vertex
  std::vector<std::uint32_t> indices;          // three a triangle, in triangle order
  std::vector<std::uint32_t> sourceTriangle;   // per triangle: its index in its mesh of the source file,
                                               // degenerate triangles counted
  std::vector<shared::Cluster> clusters;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<MaterialInfo> materials;

  // Base colour images, sRGB with linear alpha, RGBA8, all of one size: layers of one array, row 0 first.
  glm::uvec2 textureSize{0};
  std::vector<std::vector<glm::u8vec4>> textures;

  Bounds bounds;                          // world; {0, 0} for a scene without triangles
  std::uint64_t degenerateTriangles = 0;  // dropped at load

  std::vector<NamedView> views;
  std::vector<NamedLight> lights;
  std::vector<NamedPath> paths;
  std::vector<NamedLightPath> lightPaths;

  std::uint64_t instancedTriangles() const {
    std::uint64_t sum = 0;
    for (const Instance& instance : instances) sum += meshes[instance.mesh].triangleCount;
    return sum;
  }
  std::uint64_t bytes() const;  // of memory held by the arrays above
};

// For a scene that names none: all of it, seen from above one corner of its bounds; a sun at 50 degrees.
View defaultView(const Scene&);
Light defaultLight(const Scene&);

}  // namespace sundial
