// The seven stages of a shadow map and the choices at each (DESIGN section 1). Adding a choice is an
// enumerator, a name in stages.cpp, and the shader or C++ file that does it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sundial {

enum class Volume { scene, frustum, samples, inscribed };  // which part of light space matters
// How it is cut up: not at all, along the camera's depth by one of six rules, into tiles of light space, or
// into the faces of a cube about a point light.
enum class Partition { single, manual, uniform, log, practical, adaptive, kmeans, tiles, cube };
enum class Warp { none, rectilinear, nonOrthogonal };                 // how each part is re-parameterised
enum class Focus { loose, depth, aabb, aligned, snapped, calipers };  // how tight each part's frustum is
enum class Resolution { fixed, ranked, listed, estimated };           // how many texels each part gets
// What a texel holds, and where; depthId: which triangle's depth it is, too.
enum class Storage { depth, linear, depthId, triangle, moments };
enum class Lookup { hard, pcf, exact3x3, rgsm, spsm, evsm };  // how a view sample asks

struct Stages {
  Volume volume;
  Partition partition;
  Warp warp;
  Focus focus;
  Resolution resolution;
  Storage storage;
  Lookup lookup;
};

// Whether the plan depends on what the camera sees.
inline bool asksSamples(const Stages& s) {
  return s.volume == Volume::samples || s.volume == Volume::inscribed ||
         s.resolution == Resolution::estimated;
}
inline bool keepsIds(Storage s) { return s == Storage::depthId || s == Storage::triangle; }
// Lookups that want every triangle in every texel that it touches.
inline bool asksTriangles(Lookup l) { return l == Lookup::rgsm || l == Lookup::spsm; }
inline bool cutsDepth(Partition p) {
  return p != Partition::single && p != Partition::tiles && p != Partition::cube;
}

// "volume", ... in the order of execution.
std::vector<std::string_view> stageNames();
std::vector<std::string_view> stageChoices(std::string_view stage);
std::string_view stageChoice(const Stages&, std::string_view stage);
// False if the stage has no such choice.
bool setStage(Stages&, std::string_view stage, std::string_view choice);

// Why these stages don't go together; nothing if they do. Every row is checked with it at start-up.
std::optional<std::string> whyImpossible(const Stages&);

}  // namespace sundial
