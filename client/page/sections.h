// The parts of a comparison's page that hold numbers, as HTML.
#pragma once

#include <string>

#include "page/page.h"

namespace sundial::page {

std::string facts(const Comparison&);         // what was rendered, and on what
std::string numbersTable(const Comparison&);  // a row a method; the definitions are in the headers' tooltips
std::string passBars(const Comparison&);      // the time of every pass, stacked
std::string definitions();

// The share of the pixels with geometry that are wrong.
double wrongShare(const v1::Result&);

}  // namespace sundial::page
