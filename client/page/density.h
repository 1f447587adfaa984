// How densely points lie, as a grey picture.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "image/picture.h"

namespace sundial::page {

struct Density {
  image::Picture picture;  // RGB, square
  unsigned most = 0;       // points in the fullest cell
};

// The grey of a share of the way from one point (0) to `most` (1), on a logarithmic scale; nothing's is
// `kNoPoints`.
image::Rgb densityGrey(double share);
inline constexpr image::Rgb kNoPoints = {0x14, 0x17, 0x1b};

// Points of a square of that side from 0, 0, in so many cells a side; those outside of it are left out.
Density densityOf(const std::vector<glm::dvec2>& points, double side, unsigned cells);

}  // namespace sundial::page
