#include "page/plan_text.h"

#include <fmt/format.h>

#include "page/units.h"

namespace sundial::page {

std::string mapSize(const v1::PlanView& view) {
  if (view.rect_size() != 4) return "";
  return view.rect(2) == view.rect(3) ? fmt::format("{}²", view.rect(2))
                                      : fmt::format("{}×{}", view.rect(2), view.rect(3));
}

std::string texelSize(const v1::PlanView& view, bool metres) {
  return length(view.texel_size()) + (metres ? "" : " at 1 m");
}

std::string depthRange(const v1::PlanView& view) {
  if (view.depth_end() <= view.depth_begin()) return "";
  return fmt::format("{}–{} m", significant(view.depth_begin()), significant(view.depth_end()));
}

std::string tilePlace(const v1::PlanView& view) {
  return view.tile_size() == 2 ? fmt::format("column {}, row {}", view.tile(0), view.tile(1)) : "";
}

bool hasPlace(const v1::PlanView& view) { return !view.empty() || view.tile_size() == 2; }

}  // namespace sundial::page
