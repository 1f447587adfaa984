// What a lookup of triangles answered from, over the shaded picture [Lecocq et al. 2014, figure 14].
#pragma once

#include "image/picture.h"

namespace sundial::image {

// Of v1::CLASS. One triangle: grey; neighbours: green; a rebuilt edge: red.
Rgb classColour(std::uint32_t found);

// Whether any pixel has a class: false for methods with another lookup.
bool hasClasses(const client::Image& classes);

// The picture in its own colours where one triangle was enough, greenish where neighbours were asked, reddish
// where the shadow's edge was rebuilt. Both images have one size.
Picture classTint(const client::Image& colour, const client::Image& classes);

}  // namespace sundial::image
