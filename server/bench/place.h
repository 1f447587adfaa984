// Where programs look: a scene, and a view and a light of it.
#pragma once

#include <memory>
#include <string>

#include "result.h"
#include "scene/scene.h"

namespace sundial::bench {

// By name; an empty one is the scene's first.
struct Place {
  std::string scene, view = {}, light = {};  // scene: builtin:NAME?KEY=VALUE or a glTF file
};

struct Sight {
  std::shared_ptr<const Scene> scene;
  View view;
  Light light;
};

Result<Scene> loadScene(const std::string& reference);
// Throws std::runtime_error for what isn't there.
Sight sightOf(const Place&);

// Without where it comes from.
std::string shortName(const std::string& reference);

}  // namespace sundial::bench
