#include "scene/gltf/materials.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/gltf/image.h"
#include "scene/quoted_name.h"

namespace sundial::gltf {

namespace {

constexpr float kBlendCutoff = 0.5f;

std::uint32_t wrapMode(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return shared::kWrapClamp;
  return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? shared::kWrapMirror : shared::kWrapRepeat;
}

double number(const tinygltf::Value& object, const char* key, double fallback) {
  return object.Has(key) ? object.Get(key).GetNumberAsDouble() : fallback;
}

glm::vec2 pair(const tinygltf::Value& object, const char* key, glm::vec2 fallback) {
  if (!object.Has(key)) return fallback;
  const tinygltf::Value& array = object.Get(key);
  return {array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble()};
}

// KHR_texture_transform: offset * rotation * scale, its rotation counter-clockwise in (u, 1 - v).
TexCoordUse texCoordUse(const tinygltf::TextureInfo& info) {
  TexCoordUse use{.set = static_cast<unsigned>(info.texCoord)};
  const auto extension = info.extensions.find("KHR_texture_transform");
  if (extension == info.extensions.end()) return use;
  const tinygltf::Value& transform = extension->second;
  const glm::vec2 offset = pair(transform, "offset", glm::vec2(0));
  const glm::vec2 scale = pair(transform, "scale", glm::vec2(1));
  const double rotation = number(transform, "rotation", 0);
  const auto c = static_cast<float>(std::cos(rotation)), s = static_cast<float>(std::sin(rotation));
  use.set = static_cast<unsigned>(number(transform, "texCoord", use.set));
  use.uvFromTexCoord = glm::mat3(glm::vec3(c * scale.x, -s * scale.x, 0),
                                 glm::vec3(s * scale.y, c * scale.y, 0), glm::vec3(offset, 1));
  return use;
}

Result<MaterialUse> readMaterial(const tinygltf::Material& from) {
  MaterialUse use;
  use.info.name = from.name;
  use.info.doubleSided = from.doubleSided;
  const std::vector<double>& factor = from.pbrMetallicRoughness.baseColorFactor;
  use.info.gpu = {.baseColour = glm::vec4(factor[0], factor[1], factor[2], factor[3]),
                  .alphaCutoff = 0,
                  .texture = shared::kNoTexture,
                  .wrapU = shared::kWrapRepeat,
                  .wrapV = shared::kWrapRepeat};
  if (from.alphaMode == "MASK")
    use.info.gpu.alphaCutoff = static_cast<float>(from.alphaCutoff);
  else if (from.alphaMode == "BLEND")
    use.info.gpu.alphaCutoff = kBlendCutoff;
  else if (from.alphaMode != "OPAQUE")
    return invalid(fmt::format("alpha mode {} must be OPAQUE, MASK or BLEND: export the file again",
                               quotedName(from.alphaMode)));
  use.texCoord = texCoordUse(from.pbrMetallicRoughness.baseColorTexture);
  return use;
}

// Alpha can only matter where some of it can be below the cutoff; testing it elsewhere would cost for
// nothing.
void decideMasked(MaterialInfo& material, bool tinted, std::span<const std::uint8_t> leastAlpha) {
  shared::Material& gpu = material.gpu;
  const float texture =
      gpu.texture == shared::kNoTexture ? 1.0f : static_cast<float>(leastAlpha[gpu.texture]) / 255;
  const float least = tinted ? 0.0f : gpu.baseColour.a * texture;
  material.masked = least < gpu.alphaCutoff;
  if (!material.masked) gpu.alphaCutoff = 0;
}

std::uint8_t leastAlphaOf(const Texture& texture) {
  return std::ranges::min(texture.texels, {}, [](const glm::u8vec4& texel) { return texel.a; }).a;
}

// Decodes images side by side, after their bytes were found and paid for.
Result<std::vector<Texture>> decodeImages(std::span<const std::size_t> images, BufferData& data,
                                          Budget& budget) {
  const auto named = [&](std::size_t i, const Error& error) {
    return fail(error.code, error.message.starts_with("images[")
                                ? error.message
                                : fmt::format("images[{}]: {}", images[i], error.message));
  };
  std::vector<Bytes> bytes;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Result<Bytes> image = data.image(images[i]);
    if (!image) return std::unexpected(image.error());
    const Result<glm::uvec2> size = imageSize(*image);
    if (!size) return named(i, size.error());
    if (auto ok = budget.spend(std::uint64_t{size->x} * size->y, sizeof(glm::u8vec4)); !ok)
      return named(i, ok.error());
    bytes.push_back(*image);
  }
  std::vector<Result<Texture>> decoded(images.size());
  tbb::parallel_for(std::size_t{0}, images.size(),
                    [&](std::size_t i) { decoded[i] = decodeImage(bytes[i]); });
  std::vector<Texture> textures;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (!decoded[i]) return named(i, decoded[i].error());
    textures.push_back(std::move(*decoded[i]));
  }
  return textures;
}

}  // namespace

Result<Materials> readMaterials(const Document& document, std::span<const MaterialDemand> demand,
                                BufferData& data, Budget& budget) {
  const tinygltf::Model& model = document.model;
  Materials result;
  std::vector<std::size_t> images;              // per texture of the result
  std::map<std::size_t, std::uint32_t> layers;  // and back
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const tinygltf::Material& from = model.materials[i];
    Result<MaterialUse> use = readMaterial(from);
    if (!use) return fail(use.error().code, fmt::format("materials[{}]: {}", i, use.error().message));
    const int textureIndex = from.pbrMetallicRoughness.baseColorTexture.index;
    if (demand[i].used && textureIndex >= 0) {
      const tinygltf::Texture& texture = model.textures[static_cast<std::size_t>(textureIndex)];
      if (texture.source >= 0) {
        const auto image = static_cast<std::size_t>(texture.source);
        const auto [known, isNew] = layers.try_emplace(image, static_cast<std::uint32_t>(images.size()));
        use->info.gpu.texture = known->second;
        if (isNew) images.push_back(image);
      }
      if (texture.sampler >= 0) {
        const tinygltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(texture.sampler)];
        use->info.gpu.wrapU = wrapMode(sampler.wrapS);
        use->info.gpu.wrapV = wrapMode(sampler.wrapT);
      }
    }
    result.materials.push_back(std::move(*use));
  }
  Result<MaterialUse> fallback = readMaterial(tinygltf::Material());
  fallback->info.name = "default";
  result.materials.push_back(std::move(*fallback));

  Result<std::vector<Texture>> textures = decodeImages(images, data, budget);
  if (!textures) return std::unexpected(textures.error());
  result.textures = std::move(*textures);

  std::vector<std::uint8_t> leastAlpha;
  for (const Texture& texture : result.textures) leastAlpha.push_back(leastAlphaOf(texture));
  for (std::size_t i = 0; i < model.materials.size(); ++i)
    decideMasked(result.materials[i].info, demand[i].tinted, leastAlpha);
  return result;
}

}  // namespace sundial::gltf
