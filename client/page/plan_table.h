// The views of every method's plan, in numbers.
#pragma once

#include <string>

#include "page/page.h"

namespace sundial::page {

// A table a method, as HTML; nothing for methods without a plan.
std::string planTables(const Comparison&);

}  // namespace sundial::page
