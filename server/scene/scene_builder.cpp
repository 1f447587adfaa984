#include "scene/scene_builder.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/primitive_build.h"
#include "scene/quoted_name.h"
#include "scene/texture_resize.h"

namespace sundial {

namespace {

// Where a built primitive's parts go in the scene.
struct Place {
  std::uint32_t vertex = 0, triangle = 0, cluster = 0;
  std::uint32_t mesh = 0;
  std::uint32_t sourceTriangle = 0;  // triangles of the mesh's primitives before it
};

bool isFinite(const glm::dmat4& m) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(m[column][row])) return false;
  return true;
}

Result<void> checkTransform(const glm::dmat4& m) {
  if (!isFinite(m)) return invalid("its transform is not finite: repair it");
  if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
    return invalid("its transform is not affine: the last row must be 0 0 0 1");
  // Unit columns first: a tiny scale is no singularity.
  glm::dmat3 linear(m);
  for (int column = 0; column < 3; ++column) {
    const double length = glm::length(linear[column]);
    if (!(length > 0) || !std::isfinite(length))
      return invalid("its transform is singular: a scale is 0; give it a small one instead");
    linear[column] /= length;
  }
  if (!(std::abs(glm::determinant(linear)) > 1e-12))
    return invalid("its transform is singular: it flattens the mesh; repair it");
  return {};
}

void computeBounds(Scene& scene) {
  for (Mesh& mesh : scene.meshes) {
    if (mesh.clusterCount == 0) continue;
    mesh.boundsMin = scene.clusters[mesh.firstCluster].boundsMin;
    mesh.boundsMax = scene.clusters[mesh.firstCluster].boundsMax;
    for (std::uint32_t i = 1; i < mesh.clusterCount; ++i) {
      mesh.boundsMin = glm::min(mesh.boundsMin, scene.clusters[mesh.firstCluster + i].boundsMin);
      mesh.boundsMax = glm::max(mesh.boundsMax, scene.clusters[mesh.firstCluster + i].boundsMax);
    }
  }
  if (scene.instances.empty()) return;
  scene.bounds.min = glm::dvec3(std::numeric_limits<double>::max());
  scene.bounds.max = glm::dvec3(std::numeric_limits<double>::lowest());
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p(corner & 1 ? mesh.boundsMax.x : mesh.boundsMin.x,
                         corner & 2 ? mesh.boundsMax.y : mesh.boundsMin.y,
                         corner & 4 ? mesh.boundsMax.z : mesh.boundsMin.z);
      const glm::dvec3 world(instance.worldFromMesh * glm::dvec4(p, 1));
      scene.bounds.min = glm::min(scene.bounds.min, world);
      scene.bounds.max = glm::max(scene.bounds.max, world);
    }
  }
}

void placeTextures(Scene& scene, std::vector<Texture>& textures) {
  for (const Texture& texture : textures) scene.textureSize = glm::max(scene.textureSize, texture.size);
  scene.textureSize = glm::min(scene.textureSize, glm::uvec2(kMaxTextureSide));
  scene.textures.resize(textures.size());
  tbb::parallel_for(std::size_t{0}, textures.size(), [&](std::size_t i) {
    scene.textures[i] = textures[i].size == scene.textureSize
                            ? std::move(textures[i].texels)
                            : resizeTexture(textures[i], scene.textureSize).texels;
    textures[i] = {};
  });
}

}  // namespace

SceneBuilder::SceneBuilder(std::string name) { scene_.name = std::move(name); }

std::uint32_t SceneBuilder::addTexture(Texture texture) {
  textures_.push_back(std::move(texture));
  return static_cast<std::uint32_t>(textures_.size() - 1);
}

std::uint32_t SceneBuilder::addMaterial(MaterialInfo material) {
  scene_.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

std::uint32_t SceneBuilder::addMesh(std::string name, std::vector<Primitive> primitives) {
  meshes_.push_back({std::move(name), std::move(primitives)});
  return static_cast<std::uint32_t>(meshes_.size() - 1);
}

void SceneBuilder::addInstance(std::string name, std::uint32_t mesh, const glm::dmat4& worldFromMesh) {
  scene_.instances.push_back({worldFromMesh, mesh, std::move(name)});
}

void SceneBuilder::addView(NamedView view) { scene_.views.push_back(std::move(view)); }
void SceneBuilder::addLight(NamedLight light) { scene_.lights.push_back(std::move(light)); }
void SceneBuilder::addPath(NamedPath path) { scene_.paths.push_back(std::move(path)); }
void SceneBuilder::addLightPath(NamedLightPath path) { scene_.lightPaths.push_back(std::move(path)); }

Result<void> SceneBuilder::check() const {
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    const Texture& texture = textures_[i];
    if (texture.texels.empty() ||
        texture.texels.size() != static_cast<std::uint64_t>(texture.size.x) * texture.size.y)
      return invalid(fmt::format("texture {} has {} texels, not {} x {}: give a whole image", i,
                                 texture.texels.size(), texture.size.x, texture.size.y));
  }
  for (const MaterialInfo& material : scene_.materials)
    if (material.gpu.texture != shared::kNoTexture && material.gpu.texture >= textures_.size())
      return invalid(fmt::format("material {} uses texture {}, but there are {}", quotedName(material.name),
                                 material.gpu.texture, textures_.size()));
  for (const NamedMesh& mesh : meshes_)
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i)
      if (mesh.primitives[i].material >= scene_.materials.size())
        return invalid(fmt::format("mesh {}, primitive {}: material {} is out of range, there are {}",
                                   quotedName(mesh.name), i, mesh.primitives[i].material,
                                   scene_.materials.size()));
  for (const Instance& instance : scene_.instances) {
    if (instance.mesh >= meshes_.size())
      return invalid(fmt::format("instance {}: mesh {} is out of range, there are {}",
                                 quotedName(instance.name), instance.mesh, meshes_.size()));
    if (auto ok = checkTransform(instance.worldFromMesh); !ok)
      return invalid(fmt::format("instance {} of mesh {}: {}", quotedName(instance.name),
                                 quotedName(meshes_[instance.mesh].name), ok.error().message));
  }
  return {};
}

Result<Scene> SceneBuilder::finish() && {
  if (auto ok = check(); !ok) return std::unexpected(ok.error());

  // Build all primitives side by side.
  struct Source {
    std::uint32_t mesh, primitive;
  };
  std::vector<Source> sources;
  for (std::uint32_t m = 0; m < meshes_.size(); ++m)
    for (std::uint32_t p = 0; p < meshes_[m].primitives.size(); ++p) sources.push_back({m, p});
  std::vector<Result<BuiltPrimitive>> built(sources.size());
  tbb::parallel_for(std::size_t{0}, sources.size(), [&](std::size_t i) {
    built[i] = buildPrimitive(meshes_[sources[i].mesh].primitives[sources[i].primitive]);
  });
  for (std::size_t i = 0; i < built.size(); ++i)
    if (!built[i])
      return fail(built[i].error().code,
                  fmt::format("mesh {}, primitive {}: {}", quotedName(meshes_[sources[i].mesh].name),
                              sources[i].primitive, built[i].error().message));

  // Decide where each goes.
  std::vector<Place> places(sources.size());
  std::uint64_t vertices = 0, triangles = 0, clusters = 0;
  std::size_t next = 0;
  for (std::uint32_t m = 0; m < meshes_.size(); ++m) {
    Mesh mesh{.name = std::move(meshes_[m].name),
              .firstCluster = static_cast<std::uint32_t>(clusters),
              .firstTriangle = static_cast<std::uint32_t>(triangles)};
    std::uint64_t sourceTriangles = 0;
    for (const Primitive& primitive : meshes_[m].primitives) {
      const BuiltPrimitive& part = *built[next];
      places[next] = {static_cast<std::uint32_t>(vertices), static_cast<std::uint32_t>(triangles),
                      static_cast<std::uint32_t>(clusters), m, static_cast<std::uint32_t>(sourceTriangles)};
      vertices += part.vertices.size();
      triangles += part.sourceTriangle.size();
      clusters += part.clusters.size();
      sourceTriangles += primitive.indices.size() / 3;
      scene_.degenerateTriangles += part.degenerateTriangles;
      ++next;
    }
    if (vertices > std::numeric_limits<std::uint32_t>::max() ||
        3 * triangles > std::numeric_limits<std::uint32_t>::max())
      return fail(ErrorCode::resourceExhausted,
                  fmt::format("{} vertices and {} triangles are more than 32 bits can index: split the scene",
                              vertices, triangles));
    mesh.clusterCount = static_cast<std::uint32_t>(clusters) - mesh.firstCluster;
    mesh.triangleCount = static_cast<std::uint32_t>(triangles) - mesh.firstTriangle;
    scene_.meshes.push_back(std::move(mesh));
  }

  // Put them there, counting from the scene's first.
  scene_.vertices.resize(vertices);
  scene_.attributes.resize(vertices);
  scene_.indices.resize(3 * triangles);
  scene_.sourceTriangle.resize(triangles);
  scene_.clusters.resize(clusters);
  tbb::parallel_for(std::size_t{0}, sources.size(), [&](std::size_t i) {
    BuiltPrimitive& part = *built[i];
    const Place& place = places[i];
    for (shared::Vertex& vertex : part.vertices)
      if (vertex.triangle != kNoTriangle) vertex.triangle += place.triangle;
    for (shared::Cluster& cluster : part.clusters) {
      cluster.firstIndex += 3 * place.triangle;
      cluster.mesh = place.mesh;
    }
    std::ranges::copy(part.vertices, scene_.vertices.begin() + place.vertex);
    std::ranges::copy(part.attributes, scene_.attributes.begin() + place.vertex);
    std::ranges::transform(part.indices, scene_.indices.begin() + 3 * std::ptrdiff_t{place.triangle},
                           [&](std::uint32_t index) { return index + place.vertex; });
    std::ranges::transform(part.sourceTriangle, scene_.sourceTriangle.begin() + place.triangle,
                           [&](std::uint32_t source) { return source + place.sourceTriangle; });
    std::ranges::copy(part.clusters, scene_.clusters.begin() + place.cluster);
    part = {};
    meshes_[sources[i].mesh].primitives[sources[i].primitive] = {};
  });

  // An instance of nothing would only have to be skipped everywhere.
  std::erase_if(scene_.instances,
                [&](const Instance& instance) { return scene_.meshes[instance.mesh].triangleCount == 0; });
  placeTextures(scene_, textures_);
  computeBounds(scene_);
  return std::move(scene_);
}

}  // namespace sundial
