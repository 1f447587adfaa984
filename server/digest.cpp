#include "digest.h"

#include "sundial/content_digest.h"

namespace sundial {

std::string digestOf(const SceneFiles& scene) {
  ContentDigest hash;
  hash.add("files");
  if (const auto main = scene.files.find(scene.main); main != scene.files.end()) hash.add(main->second);
  for (const auto& [name, content] : scene.files) {  // a map: sorted by name
    if (name == scene.main) continue;
    hash.add(name);
    hash.add(content);
  }
  return hash.hexadecimal();
}

std::string digestOfBuiltin(std::string_view canonicalReference) {
  ContentDigest hash;
  hash.add("builtin");
  hash.add(canonicalReference);
  return hash.hexadecimal();
}

}  // namespace sundial
