// A method's plan drawn over light space.
#pragma once

#include <string>

#include "sundial/rendering.h"

namespace sundial::page {

// An SVG file: how densely the view samples that face the light lie in light space, the camera's frustum as a
// wireframe, and each view of the plan in its colour (image::viewColour) with its texels. A method without a
// plan gets a note. Needs the colour, visibility, position and view images. The density has so many cells a
// side: they are most of the file's size.
std::string planPicture(const client::MethodRendering&, const v1::View&, const v1::Light&,
                        unsigned cells = 360);

// An SVG file that holds one line of text, of the same size.
std::string planNote(std::string_view text);

}  // namespace sundial::page
