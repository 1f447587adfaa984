// What lookups of triangles read from tables instead of computing it: texels of the buffer at kBindTables.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace sundial {

// First kSlopeCodes texels: the slope that a code stands for and the most that it was rounded by, as the bits
// of floats [Lecocq et al. 2014, section 3.4]. Then 256: edgesOfPattern() of each pattern, and 0 [the same,
// figure 8].
std::vector<glm::uvec2> lookupTables();

}  // namespace sundial
