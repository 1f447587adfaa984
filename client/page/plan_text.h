// What a shadow view is, in words: of labels and tables.
#pragma once

#include <string>

#include "sundial/v1/sundial.pb.h"

namespace sundial::page {

std::string mapSize(const v1::PlanView&);                 // "1024²", "512×256": texels
std::string texelSize(const v1::PlanView&, bool metres);  // "9.8 mm", of a spot "9.8 mm at 1 m"
std::string depthRange(const v1::PlanView&);  // "2.1–8.4 m" of the camera's; "" where it has none
std::string tilePlace(const v1::PlanView&);   // "column 2, row 0"; "" without tiles

// Where the view lies in light space means something.
bool hasPlace(const v1::PlanView&);

}  // namespace sundial::page
