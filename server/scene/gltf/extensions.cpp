#include "scene/gltf/extensions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "scene/quoted_name.h"

namespace sundial::gltf {

namespace {

constexpr std::array<std::string_view, 4> kRead{"EXT_meshopt_compression", "KHR_lights_punctual",
                                                "KHR_mesh_quantization", "KHR_texture_transform"};

// They change how a surface shines, but neither its shape nor its holes.
constexpr std::array<std::string_view, 12> kHarmless{
    "KHR_materials_anisotropy", "KHR_materials_clearcoat",   "KHR_materials_dispersion",
    "KHR_materials_ior",        "KHR_materials_iridescence", "KHR_materials_emissive_strength",
    "KHR_materials_sheen",      "KHR_materials_specular",    "KHR_materials_transmission",
    "KHR_materials_unlit",      "KHR_materials_variants",    "KHR_materials_volume"};

}  // namespace

Result<void> checkRequiredExtensions(const nlohmann::json& document) {
  if (!document.is_object() || !document.contains("extensionsRequired")) return {};
  const nlohmann::json& required = document["extensionsRequired"];
  if (!required.is_array()) return {};  // the schema reports it
  for (const nlohmann::json& extension : required) {
    if (!extension.is_string()) continue;
    const auto& name = extension.get_ref<const std::string&>();
    if (std::ranges::find(kRead, name) == kRead.end() &&
        std::ranges::find(kHarmless, name) == kHarmless.end())
      return invalid(
          fmt::format("the file requires the extension {}, which is not supported; supported are {} and "
                      "KHR_materials_* that only change shading: export it without",
                      quotedName(name), fmt::join(kRead, ", ")));
  }
  return {};
}

}  // namespace sundial::gltf
