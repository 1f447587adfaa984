#include "shadow/stages.h"

#include <algorithm>
#include <array>

namespace sundial {

namespace {

// A stage as text: what its choices are called, in the order of the enumerators, and where it lives in
// Stages.
struct StageText {
  std::string_view name;
  std::vector<std::string_view> choices;
  int (*get)(const Stages&);
  void (*set)(Stages&, int);
};

template <auto member>
StageText stageText(std::string_view name, std::vector<std::string_view> choices) {
  return {name, std::move(choices), [](const Stages& s) { return static_cast<int>(s.*member); },
          [](Stages& s, int i) { s.*member = static_cast<std::remove_reference_t<decltype(s.*member)>>(i); }};
}

const std::array<StageText, 7>& stageTexts() {
  static const std::array<StageText, 7> texts = {
      stageText<&Stages::volume>("volume", {"scene", "frustum", "samples", "inscribed"}),
      stageText<&Stages::partition>("partition", {"single", "manual", "uniform", "log", "practical",
                                                  "adaptive", "kmeans", "tiles", "cube"}),
      stageText<&Stages::warp>("warp", {"none", "rectilinear", "non-orthogonal"}),
      stageText<&Stages::focus>("focus", {"loose", "depth", "aabb", "aligned", "snapped", "calipers"}),
      stageText<&Stages::resolution>("resolution", {"fixed", "ranked", "listed", "estimated"}),
      stageText<&Stages::storage>("storage", {"depth", "linear", "depth-id", "triangle", "moments"}),
      stageText<&Stages::lookup>("lookup", {"hard", "pcf", "exact-3x3", "rgsm", "spsm", "evsm"})};
  return texts;
}

const StageText* find(std::string_view stage) {
  const auto found = std::ranges::find(stageTexts(), stage, &StageText::name);
  return found == stageTexts().end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string_view> stageNames() {
  std::vector<std::string_view> names;
  for (const StageText& text : stageTexts()) names.push_back(text.name);
  return names;
}

std::vector<std::string_view> stageChoices(std::string_view stage) {
  const StageText* text = find(stage);
  return text ? text->choices : std::vector<std::string_view>{};
}

std::string_view stageChoice(const Stages& stages, std::string_view stage) {
  const StageText* text = find(stage);
  return text ? text->choices[text->get(stages)] : std::string_view{};
}

bool setStage(Stages& stages, std::string_view stage, std::string_view choice) {
  const StageText* text = find(stage);
  if (!text) return false;
  const auto found = std::ranges::find(text->choices, choice);
  if (found == text->choices.end()) return false;
  text->set(stages, static_cast<int>(found - text->choices.begin()));
  return true;
}

std::optional<std::string> whyImpossible(const Stages& stages) {
  const bool tiles = stages.partition == Partition::tiles, cube = stages.partition == Partition::cube;
  const bool single = stages.partition == Partition::single || cube;  // a map to each side of the light
  const bool samples = stages.volume == Volume::samples;
  if (tiles != (stages.volume == Volume::inscribed))
    return "partition=tiles cuts the square of volume=inscribed, and nothing else does: use both or neither";
  if (cutsDepth(stages.partition) && stages.volume == Volume::scene)
    return "a partition along the camera's depth needs to know the camera: use volume=frustum or "
           "volume=samples";
  const bool calipers = stages.focus == Focus::calipers;
  if (calipers && (!single || stages.volume != Volume::frustum))
    return "focus=calipers fits one map to what the camera could see: use volume=frustum with "
           "partition=single";
  if (calipers && stages.storage == Storage::moments)
    return "focus=calipers fits near and far, which all maps of moments share: use focus=aabb with "
           "storage=moments";
  if (single && !calipers && stages.volume == Volume::frustum)
    return "volume=frustum is bounded by ranges of depth: use a partition along it, "
           "or focus=calipers";
  if ((stages.partition == Partition::adaptive || stages.partition == Partition::kmeans) && !samples)
    return "partition=adaptive and partition=kmeans look at the histogram of the view samples: use "
           "volume=samples";
  const bool estimated = stages.resolution == Resolution::estimated;
  if (!estimated && tiles != (stages.resolution != Resolution::fixed))
    return "tiles, and nothing else, share out a list of sizes: use partition=tiles with resolution=ranked "
           "or listed";
  if (cube && stages.focus == Focus::aligned)
    return "focus=aligned turns a map to the camera's depth, and a cube's faces lie about the light: use "
           "focus=aabb";
  if (cube && stages.storage == Storage::moments)
    return "storage=moments is filtered within one map, and shadows would break at the edges of "
           "partition=cube: use storage=depth with lookup=pcf";
  if (stages.warp != Warp::none) {
    if (!single || !samples)
      return "a warp is made for the samples in a map: use volume=samples with partition=single, or "
             "partition=cube around a point light";
    if (stages.resolution != Resolution::fixed)
      return "a warp shares out the texels of a map of given size: use resolution=fixed";
    if (stages.storage != Storage::depth && stages.storage != Storage::linear)
      return "warped maps hold depths alone: use storage=depth";
  }
  if (estimated && stages.storage == Storage::moments)
    return "moments are kept in layers of one size: use resolution=fixed with storage=moments";
  if (tiles && (stages.storage == Storage::depth || stages.storage == Storage::moments))
    return "tiles of different sizes don't fit an image: use storage=linear or storage=depth-id";
  if (stages.lookup == Lookup::exact3x3 && stages.storage != Storage::depthId)
    return "lookup=exact-3x3 asks which triangle a texel holds: use it with storage=depth-id";
  if (asksTriangles(stages.lookup) && !keepsIds(stages.storage))
    return "lookup=spsm and lookup=rgsm ask which triangle a texel holds: use them with storage=triangle or "
           "storage=depth-id";
  if (stages.storage == Storage::triangle && !asksTriangles(stages.lookup))
    return "storage=triangle is read by lookup=spsm and lookup=rgsm alone: use one of them, or another "
           "storage";
  if ((stages.storage == Storage::moments) != (stages.lookup == Lookup::evsm))
    return "moments of depth are read by lookup=evsm, and by nothing else: use it with storage=moments";
  if (stages.focus == Focus::depth && !tiles)
    return "focus=depth fits near and far of tiles: use partition=tiles";
  if ((stages.focus == Focus::aligned || stages.focus == Focus::snapped) && !samples)
    return "focus=aligned and focus=snapped fit boxes to the view samples, which volume=samples looks at";
  if (stages.focus == Focus::snapped && single)
    return "focus=snapped fits partitions along the camera's depth: partition=log,partitions=1 for one map";
  if (stages.focus == Focus::aabb && !samples && !tiles)
    return "focus=aabb fits a box to the view samples, which only volume=samples looks at";
  if (stages.focus == Focus::loose && samples && single)
    return "volume=samples knows nothing but the samples, so its frustum is theirs: use focus=aabb";
  return std::nullopt;
}

}  // namespace sundial
