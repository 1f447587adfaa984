// A case's pictures, small enough that a page of hundreds holds them all.
#pragma once

#include <filesystem>
#include <vector>

#include "image/file.h"
#include "sundial/rendering.h"
#include "sweep/cases.h"

namespace sundial::sweep {

// What a request must ask for.
inline constexpr v1::Aov kPictureImages[] = {v1::COLOUR, v1::VISIBILITY, v1::REFERENCE, v1::POSITION,
                                             v1::VIEW};

// In `folder`, named by the case: the picture, where it is wrong, and its plan. At most 512 pixels wide, and
// as a rule at most 25 KB each.
std::vector<image::OutputFile> makePictures(const Case&, const client::Rendering&,
                                            const std::filesystem::path& folder);

// Their names as the line has them, seen from the folder of `results`.
v1::SweepImages pictureNames(const std::vector<image::OutputFile>&, const std::filesystem::path& results);

}  // namespace sundial::sweep
