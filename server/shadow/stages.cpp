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
  static const std::array<StageText, 7> texts = {stageText<&Stages::volume>("volume", {"scene", "samples"}),
                                                 stageText<&Stages::partition>("partition", {"single"}),
                                                 stageText<&Stages::warp>("warp", {"none"}),
                                                 stageText<&Stages::focus>("focus", {"loose", "aabb"}),
                                                 stageText<&Stages::resolution>("resolution", {"fixed"}),
                                                 stageText<&Stages::storage>("storage", {"depth"}),
                                                 stageText<&Stages::lookup>("lookup", {"hard", "pcf"})};
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
  if (stages.focus == Focus::aabb && stages.volume != Volume::samples)
    return "focus=aabb fits a box to the view samples, which only volume=samples looks at";
  if (stages.focus == Focus::loose && stages.volume == Volume::samples)
    return "volume=samples knows nothing but the samples, so its frustum is theirs: use focus=aabb";
  return std::nullopt;
}

}  // namespace sundial
