// What the report's page embeds; made part of the command by chart/assets.cmake.
#pragma once

#include <string_view>

namespace sundial::chart {

std::string_view vegaScript();    // the chart library, minified
std::string_view vegaLicences();  // of it and of what it contains
std::string_view reportScript();  // ours, its files joined to one
std::string_view reportStyle();   // beside the style of every page
std::string_view reportBody();    // with {{places}}

}  // namespace sundial::chart
