// The named cases: where each method fails, and where every method must not (DESIGN section 3). A case is a
// row here: the server lists it, the command runs it, tests loop over it.
#pragma once

#include <span>
#include <string_view>

namespace sundial {

struct StabilityCase {
  std::string_view name, sentence;  // the sentence says what happens and why
  std::string_view scene;           // "builtin:..."
  std::string_view path, view;      // one of them, of the scene: a path, or a view that stands still
  std::string_view light;           // of the scene
  std::string_view methods;         // "sm,texels=512 dv": if the first is to fail, it and one that doesn't
  std::string_view measure;         // flip_rate, pop, texel_jump, wrong_rate, bleed, drawn or wrong_pixels
  double failsAbove = 0;  // > 0: the measure of methods[0] is at least this, and 3 times that of methods[1]
  double atMost = 0;      // else: the measure of every method is at most this beyond 1.25 times the twin's
  std::string_view twinScene = {};  // "": none, its measure counts as 0
  unsigned frames = 0;              // 0: the path's own
};

std::span<const StabilityCase> stabilityCases();

}  // namespace sundial
