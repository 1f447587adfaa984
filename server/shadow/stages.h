// The seven stages of a shadow map and the choices at each (DESIGN section 1). Adding a choice is an
// enumerator, a name in stages.cpp, and the shader or C++ file that does it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sundial {

enum class Volume { scene, samples };  // which part of light space matters
enum class Partition { single };       // how it is cut up
enum class Warp { none };              // how each part is re-parameterised
enum class Focus { loose, aabb };      // how tight each part's frustum is
enum class Resolution { fixed };       // how many texels each part gets
enum class Storage { depth };          // what a texel holds
enum class Lookup { hard, pcf };       // how a view sample asks

struct Stages {
  Volume volume;
  Partition partition;
  Warp warp;
  Focus focus;
  Resolution resolution;
  Storage storage;
  Lookup lookup;
};

// "volume", ... in the order of execution.
std::vector<std::string_view> stageNames();
std::vector<std::string_view> stageChoices(std::string_view stage);
std::string_view stageChoice(const Stages&, std::string_view stage);
// False if the stage has no such choice.
bool setStage(Stages&, std::string_view stage, std::string_view choice);

// Why these stages don't go together; nothing if they do. Every row is checked with it at start-up.
std::optional<std::string> whyImpossible(const Stages&);

}  // namespace sundial
