#include "shadow/lookup_tables.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "shared/silhouette.h"
#include "shared/triangle_texel.h"

namespace sundial {

std::vector<glm::uvec2> lookupTables() {
  std::vector<glm::uvec2> texels;
  for (unsigned code = 0; code < shared::kSlopeCodes; ++code) {
    const auto at = [](float c) { return shared::slopeOfCode(c); };
    const auto middle = static_cast<float>(code);
    const float error =
        std::max(std::abs(at(middle + 0.5f) - at(middle)), std::abs(at(middle) - at(middle - 0.5f)));
    // The outermost codes stand for all that is steeper, too.
    const float most = code <= 1 || code >= 253 ? std::numeric_limits<float>::max() : error;
    texels.emplace_back(std::bit_cast<std::uint32_t>(at(middle)), std::bit_cast<std::uint32_t>(most));
  }
  for (unsigned pattern = 0; pattern < 256; ++pattern)
    texels.emplace_back(shared::edgesOfPattern(pattern), 0);
  return texels;
}

}  // namespace sundial
