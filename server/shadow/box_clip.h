// What planes leave of boxes.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "shadow/host_cull.h"

namespace sundial {

// Planes that point inwards: dot(plane, (p, 1)) >= 0 is kept.
using Planes = std::vector<glm::dvec4>;

// The pyramid of a light's map: |x| and |y| at most `reach` times w in its space before division, as far
// away as `near` or farther.
Planes pyramidOf(const glm::dmat4& lightFromWorld, double reach, double near);

glm::dvec3 cornerOf(const WorldBox&, int corner);  // in [0, 8)

// Those of the planes that cut the box; nothing where it lies outside of one.
std::optional<Planes> cutting(const WorldBox&, const Planes&);

// Calls `each` with points whose hull holds what of the box the planes leave.
void eachCornerWithin(const WorldBox&, const Planes&, const std::function<void(const glm::dvec3&)>& each);

}  // namespace sundial
