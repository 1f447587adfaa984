// Numbers with their units, as tables and pages write them.
#pragma once

#include <string>
#include <string_view>

namespace sundial::page {

std::string percent(double share);       // "0.027 %"; "0 %" only for an exact 0
std::string milliseconds(double ms);     // "12.3"
std::string bytes(double count);         // "16 MiB"
std::string length(double metres);       // "9.8 mm", "1.25 m"
std::string significant(double number);  // three digits that count
std::string escaped(std::string_view);   // for HTML and SVG, text and attributes

}  // namespace sundial::page
