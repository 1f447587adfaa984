// A method's plan drawn over light space.
#pragma once

#include <string>

#include "sundial/rendering.h"

namespace sundial::page {

// An SVG file: how densely the view samples lie in light space, and over them each view of the plan with its
// texels. A method without a plan gets a note. Needs the colour and position images. The density has so many
// cells a side: they are most of the file's size.
std::string planPicture(const client::MethodRendering&, const v1::Light&, unsigned cells = 360);

}  // namespace sundial::page
