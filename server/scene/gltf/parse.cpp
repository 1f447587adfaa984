// glTF 2.0 into a Scene: what is placed, which meshes that needs, which materials those need, and no more.
#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "scene/gltf/container.h"
#include "scene/gltf/materials.h"
#include "scene/gltf/nodes.h"
#include "scene/load.h"
#include "scene/quoted_name.h"

namespace sundial {

namespace {

using namespace gltf;

std::size_t materialIndex(const tinygltf::Primitive& primitive, const tinygltf::Model& model) {
  return primitive.material >= 0 ? static_cast<std::size_t>(primitive.material) : model.materials.size();
}

// Which of the document's meshes are placed; the value is the mesh's index in the scene.
std::vector<std::optional<std::uint32_t>> placedMeshes(const tinygltf::Model& model, const Placed& placed) {
  std::vector<std::optional<std::uint32_t>> result(model.meshes.size());
  std::uint32_t next = 0;
  for (const MeshInstance& instance : placed.instances)
    if (!result[instance.mesh]) result[instance.mesh] = next++;
  return result;
}

Result<void> checkTriangles(const tinygltf::Model& model, std::span<const std::size_t> meshes,
                            const AccessorReader& reader, std::uint64_t maxTriangles) {
  std::uint64_t triangles = 0;
  for (const std::size_t mesh : meshes)
    for (const tinygltf::Primitive& primitive : model.meshes[mesh].primitives) {
      const std::uint64_t count = triangleCount(primitive, reader);
      if (count > maxTriangles - triangles)
        return fail(ErrorCode::resourceExhausted,
                    fmt::format("meshes[{}] {} brings more than {} triangles: split the scene or raise the "
                                "server's limit",
                                mesh, quotedName(model.meshes[mesh].name), maxTriangles));
      triangles += count;
    }
  return {};
}

std::vector<MaterialDemand> materialDemand(const tinygltf::Model& model,
                                           std::span<const std::size_t> meshes) {
  std::vector<MaterialDemand> demand(model.materials.size() + 1);
  for (const std::size_t mesh : meshes)
    for (const tinygltf::Primitive& primitive : model.meshes[mesh].primitives) {
      MaterialDemand& material = demand[materialIndex(primitive, model)];
      material.used = true;
      material.tinted |= primitive.attributes.contains("COLOR_0");
    }
  return demand;
}

Result<Scene> parse(const SceneFiles& files, const SceneLimits& limits) {
  const auto main = files.files.find(files.main);
  if (main == files.files.end()) return fail(ErrorCode::notFound, "the file is missing: upload it");
  std::uint64_t fileBytes = 0;
  for (const auto& [name, bytes] : files.files) fileBytes += bytes.size();
  if (fileBytes > limits.maxFileBytes)
    return fail(ErrorCode::resourceExhausted,
                fmt::format("the scene's files hold {} bytes, over the limit of {}: split the scene or raise "
                            "the server's limit",
                            fileBytes, limits.maxFileBytes));

  const Result<Container> container = openContainer(main->second);
  if (!container) return std::unexpected(container.error());
  const Result<Document> document = parseDocument(container->json, limits.maxDecodedBytes);
  if (!document) return std::unexpected(document.error());
  const tinygltf::Model& model = document->model;
  Result<Placed> placed = placeNodes(model, limits.maxInstances);
  if (!placed) return std::unexpected(placed.error());

  const std::vector<std::optional<std::uint32_t>> sceneMesh = placedMeshes(model, *placed);
  std::vector<std::size_t> meshes(static_cast<std::size_t>(
      std::ranges::count_if(sceneMesh, [](const auto& index) { return index.has_value(); })));
  for (std::size_t i = 0; i < sceneMesh.size(); ++i)
    if (sceneMesh[i]) meshes[*sceneMesh[i]] = i;

  Budget budget(limits.maxDecodedBytes);
  BufferData data(*document, *container, files, budget);
  AccessorReader reader(*document, data, budget);
  if (auto ok = checkTriangles(model, meshes, reader, limits.maxTriangles); !ok)
    return std::unexpected(ok.error());
  Result<Materials> materials = readMaterials(*document, materialDemand(model, meshes), data, budget);
  if (!materials) return std::unexpected(materials.error());

  SceneBuilder builder(files.main);
  for (Texture& texture : materials->textures) builder.addTexture(std::move(texture));
  for (const MaterialUse& material : materials->materials) builder.addMaterial(material.info);
  for (const std::size_t index : meshes) {
    const tinygltf::Mesh& mesh = model.meshes[index];
    std::vector<Primitive> primitives;
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const std::size_t material = materialIndex(mesh.primitives[p], model);
      Result<Primitive> primitive =
          readPrimitive(mesh.primitives[p], materials->materials[material].texCoord, reader);
      if (!primitive)
        return fail(primitive.error().code, fmt::format("meshes[{}] {}, primitives[{}]: {}", index,
                                                        quotedName(mesh.name), p, primitive.error().message));
      primitive->material = static_cast<std::uint32_t>(material);
      primitives.push_back(std::move(*primitive));
    }
    builder.addMesh(mesh.name, std::move(primitives));
  }
  for (MeshInstance& instance : placed->instances)
    builder.addInstance(std::move(instance.name), *sceneMesh[instance.mesh], instance.worldFromMesh);
  for (NamedView& view : placed->views) builder.addView(std::move(view));
  for (NamedLight& light : placed->lights) builder.addLight(std::move(light));
  return std::move(builder).finish();
}

}  // namespace

Result<Scene> parseGltf(const SceneFiles& files, const SceneLimits& limits) {
  // What libraries throw ends here: they meet the file's bytes too.
  Result<Scene> scene = [&]() -> Result<Scene> {
    try {
      return parse(files, limits);
    } catch (const std::bad_alloc&) {
      return fail(ErrorCode::resourceExhausted,
                  "there is not enough memory to decode the scene: split it, or lower the server's limits");
    } catch (const std::exception& e) {
      return invalid(fmt::format("{}: export the file again", e.what()));
    }
  }();
  if (!scene) scene.error().message = fmt::format("{}: {}", quotedName(files.main), scene.error().message);
  return scene;
}

}  // namespace sundial
