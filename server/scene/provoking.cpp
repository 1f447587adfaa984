#include "scene/provoking.h"

#include <algorithm>
#include <span>

namespace sundial {

std::vector<std::uint32_t> assignProvokingVertices(std::vector<std::uint32_t>& indices,
                                                   std::uint32_t vertexCount) {
  // A greedy matching: of a triangle's free vertices take the one that the fewest later triangles could use.
  std::vector<std::uint32_t> laterUses(vertexCount, 0);
  for (const std::uint32_t vertex : indices) ++laterUses[vertex];
  std::vector<bool> taken(vertexCount, false);

  std::vector<std::uint32_t> duplicates;
  for (std::size_t first = 0; first + 2 < indices.size(); first += 3) {
    const std::span<std::uint32_t> triangle(&indices[first], 3);
    std::size_t best = 3;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      --laterUses[triangle[corner]];
      if (taken[triangle[corner]]) continue;
      if (best == 3 || laterUses[triangle[corner]] < laterUses[triangle[best]]) best = corner;
    }
    if (best < 3) {
      std::rotate(triangle.begin(), triangle.begin() + static_cast<std::ptrdiff_t>(best), triangle.end());
      taken[triangle[0]] = true;
    } else {
      duplicates.push_back(triangle[0]);
      triangle[0] = vertexCount + static_cast<std::uint32_t>(duplicates.size()) - 1;
    }
  }
  return duplicates;
}

}  // namespace sundial
