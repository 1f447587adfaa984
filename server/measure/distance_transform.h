// Exact Euclidean distances on a pixel grid, in time linear in the pixels: Felzenszwalb and Huttenlocher,
// "Distance Transforms of Sampled Functions", Theory of Computing 8, 2012.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace sundial {

// The distance of each pixel's centre to that of the nearest pixel whose `mask` isn't 0, in pixels; infinity
// if there is none. `mask` and the result have size.x * size.y elements; a side is at most 2^20.
std::vector<float> distanceTransform(glm::uvec2 size, std::span<const std::uint8_t> mask);

}  // namespace sundial
